#include "canopeer/render/rgbd_sensor.h"

#include <bit>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/base/rng.h"
#include "canopeer/render/motion/moving_view.h"
#include "canopeer/render/surfaces/pixel_hash.h"

namespace canopeer {
namespace {

PixelLabel label_of(Ripeness ripeness) {
  switch (ripeness) {
    case Ripeness::green:
      return PixelLabel::green_fruit;
    case Ripeness::turning:
      return PixelLabel::turning_fruit;
    case Ripeness::ripe:
      break;
  }
  return PixelLabel::ripe_fruit;
}

Vec3 random_direction(Rng& rng) {
  for (;;) {
    Vec3 d;
    for (const int axis : {2, 1, 0}) d[axis] = rng.uniform(-1.0, 1.0);
    if (d.squaredNorm() > 0.01 && d.squaredNorm() <= 1.0) return d.normalized();
  }
}

Pose draw_hand_eye_error(const RgbdSensorOptions& o) {
  Pose T = Pose::Identity();
  Rng rng(o.seed, "hand-eye error");
  const Vec3 direction = random_direction(rng);
  const double distance = rng.normal(0.0, 1.0);
  const Vec3 axis = random_direction(rng);
  const double angle = rng.normal(0.0, 1.0);
  if (o.hand_eye_translation_m > 0.0) {
    T.translation() = o.hand_eye_translation_m * distance * direction;
  }
  if (o.hand_eye_rotation_rad > 0.0) {
    T.linear() = Eigen::AngleAxisd(o.hand_eye_rotation_rad * angle, axis).toRotationMatrix();
  }
  return T;
}

std::uint64_t frame_key(std::uint64_t seed, std::uint64_t number, const Pose& pose) {
  std::uint64_t key = pixel_hash(pixel_hash(seed) ^ number);
  for (int i = 0; i < 16; ++i) key = pixel_hash(key ^ std::bit_cast<std::uint64_t>(pose.data()[i]));
  return key;
}

/// The sensor's own range comes after its noise: the renderer has to see a little beyond it.
CameraIntrinsics without_range(CameraIntrinsics camera) {
  camera.min_range_m = 0.0;
  camera.max_range_m = 1e3;
  return camera;
}

}  // namespace

RgbdSensor::RgbdSensor(const Renderer& renderer, const Scene& scene,
                       const RgbdSensorOptions& options)
    : renderer_(renderer),
      options_(options),
      rays_(options.noise.any_depth() ? without_range(options.intrinsics) : options.intrinsics,
            options.lens),
      T_said_true_(draw_hand_eye_error(options)) {
  CANOPEER_CHECK(options.motion.validate(), "figures of a camera's motion are checked before");
  if (!options.lens.none() && options.rectify) {
    rectification_.emplace(options.intrinsics, options.lens);
  }
  for (const FruitTruth& fruit : scene.fruits) {
    label_of_fruit_.push_back(label_of(fruit.ripeness));
  }
}

RgbdFrame RgbdSensor::capture(const Pose& T_world_camera, std::uint64_t number) const {
  return frame_of(renderer_.render(rays_, T_world_camera * T_said_true_), T_world_camera,
                  frame_key(options_.seed, number, T_world_camera));
}

RgbdFrame RgbdSensor::capture_moving(const CameraTrack& track, double t_s,
                                     std::uint64_t number) const {
  const double stamp = stamp_of(t_s, number);
  const Pose said = track(stamp);
  const std::uint64_t key = frame_key(options_.seed, number, said);
  const CameraTrack true_track = [&](double t) -> Pose { return track(t) * T_said_true_; };
  RgbdFrame frame = frame_of(render_moving(renderer_, rays_, true_track, t_s, options_.motion,
                                           options_.noise.edge_step, key),
                             said, key);
  frame.time_s = stamp;
  return frame;
}

double RgbdSensor::stamp_of(double t_s, std::uint64_t number) const {
  return time_stamp(options_.motion, t_s, options_.seed, number);
}

RgbdFrame RgbdSensor::frame_of(RenderedView view, const Pose& T_world_camera,
                               std::uint64_t key) const {
  RgbdFrame frame;
  frame.intrinsics = options_.intrinsics;
  frame.T_world_camera = T_world_camera;
  frame.depth = options_.noise.any_depth()
                    ? noisy_depth(view.depth, options_.intrinsics, options_.noise, key)
                    : std::move(view.depth);
  frame.color = options_.noise.any_color() ? noisy_color(view.color, options_.noise, key)
                                           : std::move(view.color);
  frame.labels = labels_of(view.labels);
  if (options_.label_noise > 0.0) {
    frame.true_labels = frame.labels;
    add_label_noise(key, &frame.labels);
  }
  if (rectification_) {
    frame.depth = rectification_->apply(frame.depth, 0.0F);
    frame.color = rectification_->apply(frame.color, Rgb{});
    frame.labels = rectification_->apply(frame.labels, PixelLabel::background);
    if (options_.label_noise > 0.0) {
      frame.true_labels = rectification_->apply(frame.true_labels, PixelLabel::background);
    }
  }
  return frame;
}

Image<PixelLabel> RgbdSensor::labels_of(const Labels& truth) const {
  Image<PixelLabel> labels(truth.fruit.width(), truth.fruit.height(), PixelLabel::background);
  for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
    const int fruit = truth.fruit.pixels()[i];
    if (fruit >= 0) labels.pixels()[i] = label_of_fruit_[static_cast<std::size_t>(fruit)];
  }
  return labels;
}

void RgbdSensor::add_label_noise(std::uint64_t key, Image<PixelLabel>* labels) const {
  const std::uint64_t label_key = pixel_hash(key ^ 0x6c6162656cULL);
  for (std::size_t i = 0; i < labels->pixels().size(); ++i) {
    PixelLabel& label = labels->pixels()[i];
    const std::uint64_t bits = pixel_hash(label_key + i);
    if (static_cast<double>(bits >> 11) * 0x1.0p-53 >= options_.label_noise) continue;
    label = label == PixelLabel::background ? static_cast<PixelLabel>(1 + pixel_hash(bits) % 3)
                                            : PixelLabel::background;
  }
}

}  // namespace canopeer
