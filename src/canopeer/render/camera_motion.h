#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"

namespace canopeer {

/// How the simulated camera exposes its images while it moves, and what it says of their time.
/// Everything is off by default.
struct CameraMotionOptions {
  /// How long each pixel gathers light, s. 0: at once, sharp, whatever moves.
  double exposure_s = 0.0;
  /// Rolling shutter: from the first row's exposure to the last row's, s, top to bottom. 0: global.
  double readout_s = 0.0;
  /// False: the depth imagers have a global shutter; the readout is that of colour and labels.
  bool depth_rolls = true;
  /// From the middle of the exposure to the moment when the frame has arrived, s.
  double latency_s = 0.0;
  /// Standard deviation of time stamps, s. A frame bears the pose of its stamp.
  double stamp_jitter_s = 0.0;
  /// Constant error of time stamps that nobody knows of, s (latency that no model has); > 0: they
  /// say too late.
  double stamp_offset_s = 0.0;
  /// Most sub-frames that are rendered of a frame. About one is needed per pixel of motion.
  int sub_frames = 9;

  [[nodiscard]] bool any() const;
  /// The error names the first figure that cannot be.
  [[nodiscard]] Expected<void> validate() const;
};

/// Where the camera is at a time: T_world_camera as calibrated; mission time in s. Called by one
/// thread at a time.
using CameraTrack = std::function<Pose(double t_s)>;

/// Names that camera_motion_preset() knows: none, d435, d405, global_shutter.
[[nodiscard]] const std::vector<std::string>& camera_motion_names();

/// Figures of a camera by name, which must be known. "ls" is github.com/realsenseai/librealsense,
/// "rr" realsense-ros there; numbers are those of issues.
///
/// d435
/// - Exposure 8.5 ms, as delivered (ls 7221). Sonoda, Sweetser, Khuong, Brook & Grunnet-Jepsen,
///   "High-speed capture mode of Intel RealSense depth camera D435", Intel white paper, get by with
///   less than 6 ms in a dim office. Colour has an exposure of its own; here it has this one.
/// - Readout 16 ms, of colour only: the stereo pair has a global shutter, the colour imager a
///   rolling one (D400 family data sheet), so that colour shears against depth, more from row to
///   row (ls 5867). Its readout goes with the frame rate (ls 3554, 2724), of which 60 Hz is advised
///   where things move (ls 13285). That a readout lasts nearly a frame is our estimate.
/// - Latency 66 ms: measured for colour on ROS 2 (rr 2686; depth alone 9 ms there). The maker spoke
///   of 60 to 70 ms for depth (ls 1242).
/// - Stamps scatter by 1 ms: our estimate, below the 1.1 to 2.2 ms by which arrivals scatter
///   against stamps (ls 12430). They mean the middle of the exposure (ls 8521).
///
/// d405
/// - Exposure 11 ms: one frame of the 90 Hz that is advised against blur (rr 3078).
/// - Readout 0: depth and colour come from the same two imagers, global shutters (ls 14253).
/// - Latency and stamps as the D435's, whose processor it shares: our estimate.
///
/// global_shutter: a stereo pair of industrial cameras with flash light
/// - Exposure 2 ms: our estimate of what a flash permits.
/// - Readout 0: a global shutter, e.g. Basler ace 2 a2A1920-160 (docs.baslerweb.com).
/// - Latency 20 ms: 1 ms of exposure, 1/160 s to read the image and as long to send it (its frame
///   rate), the rest for matching. Our estimate.
/// - Stamps scatter by 0.02 ms: taken by the camera's clock as exposure starts, clocks synchronised
///   over the network (IEEE 1588). Our estimate.
[[nodiscard]] CameraMotionOptions camera_motion_preset(const std::string& name);

/// The stamp of a frame exposed around t_s: with offset and jitter; s. Of (seed, number) only.
[[nodiscard]] double time_stamp(const CameraMotionOptions& motion, double t_s, std::uint64_t seed,
                                std::uint64_t number);

}  // namespace canopeer
