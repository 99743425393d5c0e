#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopeer/sensing/coarse_depth.h"
#include "canopeer/sensing/pose_track.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// How much is kept of the frames of a run.
struct FrameSampleOptions {
  int stretches = 10;              ///< kept at most, at least 2
  int frames = 6;                  ///< of a stretch at most, at least 2
  double apart_s = 0.15;           ///< between frames of a stretch that are kept
  double longest_s = 2.5;          ///< a stretch lasts while things move
  double focal_length_px = 150.0;  ///< kept images are as coarse as that
};

/// A few frames of a run, kept as they come, to tell whether pose and image agree: of each part of
/// the run the stretch that tells most. A stretch is what the camera saw from one place at rest to
/// the next, the frames on the way between them. It tells the more the more the camera's motion, or
/// its direction, differs between two frames that look at the same. Coarse depth images, some 80 kB
/// each; the same frames, the same sample.
class FrameSample {
 public:
  explicit FrameSample(const FrameSampleOptions& options = {}) : options_(options) {}

  /// A frame from where the camera stands still. A frame that is older than one before is left out.
  void add_still(const RgbdFrame& frame);
  /// A frame on the way, and how the camera moves then.
  void add_moving(const RgbdFrame& frame, const CameraTwist& twist);
  /// It begins to move from where it stood at the last frame.
  void moves_from(double time_s);
  /// It has come to rest where the next frame is taken, if that is taken at rest.
  void rests_from(double time_s) { rests_from_s_ = time_s; }

  /// One of the frames, made small.
  struct Kept {
    double time_s = 0.0;
    CoarseDepth image;
    Pose T_world_camera = Pose::Identity();
    CameraTwist twist;
    bool moving = false;

    template <typename Archive>
    void serialize(Archive& archive) {
      CameraIntrinsics& k = image.intrinsics;
      archive(time_s, T_world_camera, twist.linear, twist.angular, moving);
      archive(k.width, k.height, k.fx, k.fy, k.cx, k.cy, k.min_range_m, k.max_range_m);
      if (image.depth.empty()) image.depth = DepthImage(k.width, k.height);  // read
      archive(image.depth.pixels());
    }
  };
  /// What was kept, by time.
  [[nodiscard]] std::vector<Kept> frames() const;
  /// Where the camera was about those times.
  [[nodiscard]] PoseTrack track() const;
  /// Of all that came.
  [[nodiscard]] int moving() const { return moving_; }

  /// All but the options.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(open_, slots_, slot_stretches_, rests_from_s_, moving_);
  }

 private:
  struct Stretch {
    std::vector<Kept> frames;
    std::vector<TrackPoint> track;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(frames, track);
    }
  };
  /// The best of so many stretches one after the other.
  struct Slot {
    Stretch best;
    double worth = 0.0;
    std::uint64_t stretches = 0;

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(best, worth, stretches);
    }
  };
  void add(const RgbdFrame& frame, const CameraTwist& twist, bool moving);
  void close();
  void join_neighbours();

  FrameSampleOptions options_;
  Stretch open_;
  std::vector<Slot> slots_;           // by time
  std::uint64_t slot_stretches_ = 1;  // that go into a slot
  std::optional<double> rests_from_s_;
  int moving_ = 0;
};

}  // namespace canopeer
