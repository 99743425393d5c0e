#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// What the camera at an arm saw of a still scene, and when, by its clock.
struct HandEyeFrame {
  double time_s = 0.0;
  CameraIntrinsics intrinsics;
  DepthImage depth;
};

/// Where the arm says the camera was: T_world_camera; nothing: not known then.
using CameraPoseAt = std::function<std::optional<Pose>(double time_s)>;

/// What is looked for, and how closely.
struct HandEyeOptions {
  double max_time_offset_s = 0.15;  ///< either way
  int max_pairs = 250;              ///< of frames that are compared
  int patches = 1500;               ///< of surface in each pair, about
  /// What is worth changing: a smaller error is none.
  double worth_m = 0.003;
  double worth_rad = 0.005;
  double worth_s = 0.008;
};

/// How frames disagree, and what would make them agree. An error within three standard errors, or
/// smaller than what is worth changing, is not called wrong; nor is one without which, the other
/// corrected, surfaces lie nearly as close.
struct HandEyeEstimate {
  Pose T_said_true = Pose::Identity();  ///< from the calibrated camera frame to where it is
  double translation_m = 0.0;           ///< of that
  double rotation_rad = 0.0;
  double translation_se_m = 0.0;  ///< standard error along the direction that is known least
  double rotation_se_rad = 0.0;
  double time_offset_s = 0.0;  ///< added to stamps of frames gives the arm's clock
  double time_offset_se_s = 0.0;
  bool hand_eye_known = false;  ///< the frames tell it: the camera turned about two axes at least
  bool time_known = false;      ///< the frames tell it: some were taken while it moved
  bool hand_eye_wrong = false;
  bool time_wrong = false;

  /// Medians of the distances between surfaces that should be one, m.
  struct Residual {
    double before_m = 0.0;
    double after_m = 0.0;  ///< with both corrections
    int points = 0;        ///< compared, after
  };
  Residual all;
  std::vector<Residual> frames;  ///< parallel to the frames; of those that meet no other: no points
};

/// Finds one constant error of the camera's mounting and one constant offset of its clock from
/// frames alone, by what surfaces at least disagree between frames: plane to plane between all
/// pairs that see something in common, robust against what was hidden in one. Frames from several
/// orientations tell the mounting, frames from while the camera moves tell the time. Deterministic.
/// The error: fewer than three frames with poses, or they have no surfaces in common.
[[nodiscard]] Expected<HandEyeEstimate> estimate_hand_eye(const std::vector<HandEyeFrame>& frames,
                                                          const CameraPoseAt& pose_at,
                                                          const HandEyeOptions& options = {});

}  // namespace canopeer
