#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/camera_intrinsics.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// The faults of a stereo depth camera and of its colour image. Everything is off by default. A
/// fault at 0 is off; all are seeded and depend on (key, pixel) only.
struct SensorNoiseOptions {
  /// Between the two imagers; disparity = fx · baseline / depth. 0: no stereo, and none of the
  /// four faults of the disparity.
  double baseline_m = 0.0;
  /// Axial noise: the standard deviation of depth is depth² · this / (fx · baseline). It is the law
  /// of stereo (Khoshelham & Oude Elberink, "Accuracy and resolution of Kinect depth data for
  /// indoor mapping applications", Sensors 12(2), 2012). For this family of cameras:
  /// Grunnet-Jepsen, Sweetser & Woodfill, "Best-known-methods for tuning Intel RealSense D400 depth
  /// cameras for best performance", Intel white paper. They reckon with about 0.08 px on
  /// well-textured walls.
  double disparity_noise_px = 0.0;
  /// Matching windows make neighbours err alike. The noise is interpolated between independent
  /// values this far apart (our choice of form). ≤ 1: every pixel for itself.
  double correlation_px = 1.0;
  /// Disparities come in steps (of 1/32 px from these cameras: librealsense reads five fractional
  /// bits); 0: any value.
  double disparity_step_px = 0.0;
  /// No return where something nearer stands between the surface and the second imager, left of a
  /// foreground object. Khoshelham & Oude Elberink describe this "shadow".
  bool baseline_shadow = false;

  /// Lateral noise: edges waver by pixels drawn with this standard deviation, after Nguyen, Izadi &
  /// Lovell, "Modeling Kinect sensor noise for improved 3D reconstruction and tracking", 3DIMPVT
  /// 2012: 0.8 px + 0.035 px · θ / (π/2 − θ) at incidence θ. The second term, 0.16 px at 74°, is
  /// left out: what grazes more is lost here. Applied as shifts of the pixel looked up, as by Handa
  /// et al., "A benchmark for RGB-D visual odometry, 3D reconstruction and SLAM", ICRA 2014.
  double lateral_px = 0.0;
  /// Depth comes in multiples of this, m.
  double depth_step_m = 0.0;
  /// Grazing surfaces give no return: certain below the first, never above the second cosine of
  /// the angle of incidence, linear between. The form is ours, after the steep rise of noise that
  /// Nguyen et al. 2012 found beyond some 60°. Both 0: off.
  double lost_below_cosine = 0.0;
  double kept_above_cosine = 0.0;
  /// Depth edges: neighbours farther apart than this share of their depth.
  double edge_step = 0.02;
  /// At an edge a pixel is lost with the first probability, else a flying pixel somewhere between
  /// both surfaces with the second (what they are: Sabov & Krüger, "Identification and correction
  /// of flying pixels in range camera data", SCCG 2008; how often is our estimate).
  double lost_at_edge = 0.0;
  double flying_at_edge = 0.0;
  /// Any pixel is lost with this probability.
  double lost_anywhere = 0.0;

  /// Colour: variance = read² + shot · value, in grey levels (Foi et al., "Practical
  /// Poissonian-Gaussian noise modeling and fitting for single-image raw-data", IEEE TIP 17, 2008).
  double color_read = 0.0;
  double color_shot = 0.0;
  /// Exposure: all values times this, clipped; each frame's own off by this standard deviation.
  double exposure = 1.0;
  double exposure_spread = 0.0;

  [[nodiscard]] bool any_depth() const;
  [[nodiscard]] bool any_color() const;
  [[nodiscard]] Expected<void> validate() const;
};

/// Names that sensor_noise_preset() knows: none, d435, d405.
[[nodiscard]] const std::vector<std::string>& sensor_noise_names();

/// Figures of a camera by name: D435 (baseline 50 mm) and D405 (18 mm) from the D400 family's data
/// sheet, noise from the sources above. The name must be known.
[[nodiscard]] SensorNoiseOptions sensor_noise_preset(const std::string& name);

/// What the sensor makes of true depth (0: no surface). The camera's range is applied last.
/// Rows are worked on in parallel; the same arguments give the same image on any machine.
[[nodiscard]] DepthImage noisy_depth(const DepthImage& depth, const CameraIntrinsics& camera,
                                     const SensorNoiseOptions& noise, std::uint64_t key);

/// The same for colour.
[[nodiscard]] ColorImage noisy_color(const ColorImage& color, const SensorNoiseOptions& noise,
                                     std::uint64_t key);

}  // namespace canopeer
