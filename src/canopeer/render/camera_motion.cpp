#include "canopeer/render/camera_motion.h"

#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/base/rng.h"

namespace canopeer {

bool CameraMotionOptions::any() const {
  return exposure_s > 0.0 || readout_s > 0.0 || latency_s > 0.0 || stamp_jitter_s > 0.0 ||
         stamp_offset_s != 0.0;
}

Expected<void> CameraMotionOptions::validate() const {
  const auto duration = [](double s, double most) { return s >= 0.0 && s <= most; };
  if (!duration(exposure_s, 1.0)) return fail("an exposure takes 0 to 1 s");
  if (!duration(readout_s, 1.0)) return fail("a readout takes 0 to 1 s");
  if (!duration(latency_s, 10.0)) return fail("a latency is 0 to 10 s");
  if (!duration(stamp_jitter_s, 1.0)) return fail("time stamps scatter by 0 to 1 s");
  if (!duration(std::abs(stamp_offset_s), 1.0)) return fail("time stamps are off by 1 s at most");
  if (sub_frames < 1 || sub_frames > 255) return fail("a frame has 1 to 255 sub-frames");
  return {};
}

const std::vector<std::string>& camera_motion_names() {
  static const std::vector<std::string> kNames = {"none", "d435", "d405", "global_shutter"};
  return kNames;
}

CameraMotionOptions camera_motion_preset(const std::string& name) {
  CameraMotionOptions o;
  if (name == "none") return o;
  if (name == "d435") {
    o.exposure_s = 0.0085;
    o.readout_s = 0.016;
    o.depth_rolls = false;
    o.latency_s = 0.066;
    o.stamp_jitter_s = 0.001;
  } else if (name == "d405") {
    o.exposure_s = 0.011;
    o.latency_s = 0.066;
    o.stamp_jitter_s = 0.001;
  } else {
    CANOPEER_CHECK(name == "global_shutter", "an unknown preset of a camera's motion");
    o.exposure_s = 0.002;
    o.latency_s = 0.020;
    o.stamp_jitter_s = 0.00002;
  }
  return o;
}

double time_stamp(const CameraMotionOptions& motion, double t_s, std::uint64_t seed,
                  std::uint64_t number) {
  double stamp = t_s + motion.stamp_offset_s;
  if (motion.stamp_jitter_s > 0.0) {
    stamp += Rng(seed, "time stamps", number).normal(0.0, motion.stamp_jitter_s);
  }
  return stamp;
}

}  // namespace canopeer
