#pragma once

#include <optional>
#include <string>

#include "canopeer/sensing/frame_sample.h"
#include "canopeer/sensing/hand_eye.h"

namespace canopeer {

/// Whether the poses of a run's frames fit what the frames show.
struct FrameAgreement {
  std::optional<HandEyeEstimate> estimate;  ///< nothing: they have too little in common
  std::string why_not;                      ///< then
  int frames = 0;                           ///< compared
  int moving = 0;                           ///< of these

  [[nodiscard]] bool time_known() const { return estimate && estimate->time_known; }
  [[nodiscard]] bool mounting_known() const { return estimate && estimate->hand_eye_known; }
  [[nodiscard]] bool wrong() const {
    return estimate && (estimate->time_wrong || estimate->hand_eye_wrong);
  }
};

/// Compares the frames that were kept (estimate_hand_eye), in well under a second. Deterministic.
[[nodiscard]] FrameAgreement judge_agreement(const FrameSample& sample);

/// What was assumed, to say what to write instead.
struct AssumedMounting {
  Pose T_frame_camera = Pose::Identity();  ///< camera_mounting of the robot file
  double time_offset_s = 0.0;              ///< added to stamps already
};

/// The verdict for people: what is wrong, by how much and what to set; or that all agrees, or what
/// the frames do not tell.
[[nodiscard]] std::string agreement_text(const FrameAgreement& agreement,
                                         const AssumedMounting& assumed);

/// A mounting as robot files have it: `{xyz_m: […], rpy_deg: […]}`.
[[nodiscard]] std::string mounting_text(const Pose& T_frame_camera);

}  // namespace canopeer
