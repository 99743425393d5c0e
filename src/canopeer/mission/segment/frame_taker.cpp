#include "canopeer/mission/segment/frame_taker.h"

#include <utility>

namespace canopeer {
namespace {

std::int64_t known_among(const VoxelSet& voxels, const VoxelMap& map) {
  std::int64_t known = 0;
  voxels.for_each([&](const VoxelIndex& voxel) {
    known += map.occupancy(voxel) == Occupancy::unknown ? 0 : 1;
  });
  return known;
}

}  // namespace

FrameTaker::FrameTaker(const RobotModel& robot, const Ports& ports, const MissionOptions& options,
                       Perception& perception)
    : ports_(ports),
      mask_robot_(options.mask_robot),
      fan_(options.planners.vmp.path_search.fan),
      self_filter_(robot, options.self_filter),
      perception_(perception) {}

Expected<Look> FrameTaker::look(const Box& region_world, bool in_fan, WorkMeter& work,
                                StageTimer& timer) {
  auto frame = timer.time("camera", [&] { return ports_.camera->capture(); });
  if (!frame) return fail_in("camera", frame.error());
  if (mask_robot_) {
    self_filter_.mask(*frame, ports_.arm->configuration(), ports_.trolley->state());
  }
  VoxelSet promised;
  if (in_fan) promised = cast_view(perception_.map(), frame->T_world_camera, fan_).unknown;
  auto seen = perception_.observe(*frame, region_world, work, timer);
  if (!seen) return tl::unexpected(seen.error());
  Look look;
  if (in_fan) look.realised_in_fan = known_among(promised, perception_.map());
  look.frame = std::make_shared<const RgbdFrame>(std::move(*frame));
  look.detection = std::make_shared<const Detection>(std::move(seen->detection));
  look.seen = std::move(*seen);
  return look;
}

}  // namespace canopeer
