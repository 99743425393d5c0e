#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "canopeer/render/camera_motion.h"
#include "canopeer/render/renderer.h"
#include "canopeer/render/sensor_noise.h"
#include "canopeer/sensing/camera_rays.h"
#include "canopeer/sensing/rectification.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

/// The camera: lens, mounting, and its faults.
struct RgbdSensorOptions {
  CameraIntrinsics intrinsics = CameraIntrinsics::from_fov(640, 480, 80.0 * std::numbers::pi / 180);
  LensDistortion lens;
  /// Frames are taken through the lens and then rectified, as by a calibrated camera; false: as
  /// seen, though everybody takes them for a pinhole's.
  bool rectify = true;
  SensorNoiseOptions noise;
  /// Blur, rolling shutter and time stamps of frames taken while it moves.
  CameraMotionOptions motion;
  /// Probability that a pixel's label is wrong: a fruit's pixel says background, another one says
  /// fruit, of any ripeness. 0 … 1; 0.3 is the "right with 0.7" of the literature.
  double label_noise = 0.0;
  /// Hand–eye error: the camera sits off its calibrated place by a translation (length) and a
  /// rotation (angle) of these standard deviations, drawn once by the seed.
  double hand_eye_translation_m = 0.0;
  double hand_eye_rotation_rad = 0.0;
  std::uint64_t seed = 1;
};

/// An RGB-D camera in a scene, with its faults.
class RgbdSensor {
 public:
  /// `renderer` and `scene` (of which only the fruits' ripeness is looked at, now) show the same.
  /// The renderer outlives the sensor.
  RgbdSensor(const Renderer& renderer, const Scene& scene, const RgbdSensorOptions& options);

  /// A frame from where the arm says the camera is. `number` counts the frames: noise differs from
  /// one to the next. time_s is left 0. Thread-safe.
  [[nodiscard]] RgbdFrame capture(const Pose& T_world_camera, std::uint64_t number) const;

  /// A frame exposed around `t_s`, the middle of the middle row's exposure, while the camera moves
  /// along `track`. Its time_s is its stamp, its T_world_camera where `track` says the camera was
  /// then. `track` is asked for that moment and for half the exposure and readout before and after
  /// t_s. While the camera stands still, or with motion off, it shows what capture() shows.
  /// Thread-safe; the same arguments give the same frame with any number of threads.
  [[nodiscard]] RgbdFrame capture_moving(const CameraTrack& track, double t_s,
                                         std::uint64_t number) const;

  /// The stamp that capture_moving() gives that frame, s.
  [[nodiscard]] double stamp_of(double t_s, std::uint64_t number) const;

  /// From the calibrated camera frame to where it really is.
  [[nodiscard]] const Pose& hand_eye_error() const { return T_said_true_; }

 private:
  /// What becomes of a view: noise, labels, rectification.
  [[nodiscard]] RgbdFrame frame_of(RenderedView view, const Pose& T_world_camera,
                                   std::uint64_t key) const;
  [[nodiscard]] Image<PixelLabel> labels_of(const Labels& truth) const;
  void add_label_noise(std::uint64_t key, Image<PixelLabel>* labels) const;

  const Renderer& renderer_;
  RgbdSensorOptions options_;
  CameraRays rays_;
  std::optional<Rectification> rectification_;
  Pose T_said_true_ = Pose::Identity();
  std::vector<PixelLabel> label_of_fruit_;
};

}  // namespace canopeer
