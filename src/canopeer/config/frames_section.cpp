#include "canopeer/config/frames_section.h"

#include "canopeer/geometry/angles.h"

namespace canopeer {

void read_frames(YamlMap& file, const CameraIntrinsics& camera, double exposure_s,
                 const PlannerManners& planner, MissionOptions& mission) {
  YamlMap frames = file.map("frames");
  OnTheWayOptions& o = mission.on_the_way;
  o.camera = camera;
  o.hz = frames.number("on_the_way_hz", o.hz, {0.0, 120.0});
  o.max_blur_px = frames.number("max_blur_px", o.max_blur_px, {0.0, 1000.0});
  const double exposure_ms = 1e3 * (exposure_s > 0.0 ? exposure_s : o.exposure_s);
  o.exposure_s = frames.number("exposure_ms", exposure_ms, {0.01, 1000.0}) / 1e3;
  o.keep_sharp = frames.boolean("keep_sharp", planner.keeps_sharp && o.max_blur_px > 0.0);
  if (o.keep_sharp && o.max_blur_px <= 0.0) {
    frames.complain("keep_sharp", "expected a max_blur_px above 0 with it");
  }
  o.sharp_distance_m = frames.number("sharp_distance_m", o.sharp_distance_m, {0.05, 10.0});
  o.new_after_m = frames.number("new_after_m", o.new_after_m, {0.0, 10.0});
  o.new_after_rad =
      frames.number("new_after_deg", o.new_after_rad / kDegree, {0.0, 180.0}) * kDegree;
  o.queue = frames.integer("queue", o.queue, 1, 1000);
  o.tell_every_s = frames.number("tell_every_s", o.tell_every_s, {0.01, 100.0});
  const std::string clock =
      file.choice("clock", o.hz > 0.0 ? "whole" : "paper", {"paper", "whole"});
  mission.clock = clock == "whole" ? MissionClock::whole : MissionClock::paper;
}

}  // namespace canopeer
