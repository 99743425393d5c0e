#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "canopeer/map/fusion.h"
#include "canopeer/map/voxel_map.h"
#include "canopeer/sensing/cloud_folder.h"
#include "canopeer/sensing/rgbd_frame.h"
#include "commands.h"

namespace canopeer::app {

/// A frame and which of its pixels are fruit (empty: nobody looked).
struct SegmentedFrame {
  RgbdFrame frame;
  Mask roi;
};
using Observation = std::variant<SegmentedFrame, PosedCloud>;

/// What was recorded, observation by observation. Const calls are thread-safe.
class Recording {
 public:
  virtual ~Recording() = default;
  [[nodiscard]] virtual std::size_t size() const = 0;
  /// The file that stands for an observation in messages.
  [[nodiscard]] virtual std::string name(std::size_t i) const = 0;
  [[nodiscard]] virtual Expected<Observation> load(std::size_t i) const = 0;
  /// Where its sensor was; nothing when only the file of the observation says it.
  [[nodiscard]] virtual std::optional<Pose> pose(std::size_t i) const = 0;
  [[nodiscard]] virtual const PoseSource& poses() const = 0;
  /// Observations that are not among them for want of a pose.
  [[nodiscard]] virtual PoseGaps gaps() const = 0;
};

/// Recognises what lies in the data set's folder.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_recording(
    const MapFuseArguments& arguments);

/// Fuses an observation into the map; returns its end points. Fails when its pose cannot be.
[[nodiscard]] Expected<std::int64_t> fuse_observation(VoxelMap& map, const Observation& observation,
                                                      const FusionOptions& fusion);

}  // namespace canopeer::app
