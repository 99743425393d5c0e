#include "canopeer/mission/segment/frame_taker.h"

#include <utility>

namespace canopeer {

FrameTaker::FrameTaker(const RobotModel& robot, const Ports& ports, const MissionOptions& options,
                       Perception& perception)
    : ports_(ports),
      mask_robot_(options.mask_robot),
      self_filter_(robot, options.self_filter),
      perception_(perception) {}

Expected<Look> FrameTaker::look(const Box& region_world, WorkMeter& work, StageTimer& timer) {
  auto frame = timer.time("camera", [&] { return ports_.camera->capture(); });
  if (!frame) return fail_in("camera", frame.error());
  if (mask_robot_) {
    self_filter_.mask(*frame, ports_.arm->configuration(), ports_.trolley->state());
  }
  auto seen = perception_.observe(*frame, region_world, work, timer);
  if (!seen) return tl::unexpected(seen.error());
  Look look;
  look.frame = std::make_shared<const RgbdFrame>(std::move(*frame));
  look.detection = std::make_shared<const Detection>(std::move(seen->detection));
  look.seen = std::move(*seen);
  return look;
}

}  // namespace canopeer
