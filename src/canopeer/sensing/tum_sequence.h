#pragma once

#include <filesystem>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/pose_source.h"
#include "canopeer/sensing/trajectory.h"

namespace canopeer {

/// How images and poses of a sequence are joined.
struct TumOptions {
  double max_difference_s = 0.02;    ///< between a depth image and its colour image
  double max_pose_gap_s = 0.25;      ///< between the poses before and after a depth image
  std::filesystem::path trajectory;  ///< empty: the sequence's own
};

/// One depth image of a sequence, and what belongs to it.
struct TumFrame {
  double time_s = 0.0;
  std::filesystem::path depth;
  std::filesystem::path color;  ///< empty: none was taken at that time
  Pose T_world_camera = Pose::Identity();
};

/// A recorded RGB-D sequence in the layout of the TUM RGB-D data sets (Sturm et al., IROS 2012).
struct TumSequence {
  std::vector<TumFrame> frames;  ///< in order of time; all have a pose
  int without_color = 0;         ///< of the frames
  PoseGaps gaps;                 ///< depth images that are no frames
  PoseSource poses;
};

/// True when `directory` looks like such a sequence: it has depth.txt or associations.txt, or a
/// folder `depth`.
[[nodiscard]] bool is_tum_sequence(const std::filesystem::path& directory);

/// Reads which images there are (associations.txt, or depth.txt and rgb.txt, or the folder `depth`
/// with time stamps or any rising names; colour in `rgb` or `color`), finds the colour
/// image nearest in time and the pose of each depth image. Poses without time stamps, or with such
/// that only count them, go to the images in order. Images are not opened, but must exist.
/// Fails on malformed lines (file:line), missing files, and when no depth image has a pose.
[[nodiscard]] Expected<TumSequence> open_tum_sequence(const std::filesystem::path& directory,
                                                      const TumOptions& options = {});

}  // namespace canopeer
