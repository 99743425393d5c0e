// Whether pose and image of a run's frames agree, found from simulated frames of rows of plants.
#include "canopeer/sensing/frame_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <utility>

#include "canopeer/base/rng.h"
#include "canopeer/render/rgbd_sensor.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// From view to view before a row, a second at rest at each, as a mission goes.
class Journey {
 public:
  Journey(std::uint64_t seed, int views) {
    Rng rng(seed, 7);
    double y = -1.0, t = 0.0;
    for (int i = 0; i < views; ++i) {
      if (i % 6 == 5) y += 0.4;  // the next plants
      const Vec3 eye(rng.uniform(0.05, 0.3), y + rng.uniform(-0.2, 0.2), rng.uniform(0.8, 1.2));
      const Vec3 target(0.75, y + rng.uniform(-0.1, 0.1), 1.0 + rng.uniform(-0.1, 0.1));
      const Pose T = look_at(eye, target, rng.uniform(-0.4, 0.4));
      if (!stops_.empty()) {
        const double way = (T.translation() - stops_.back().T.translation()).norm();
        t += 1.0;
        begins_.push_back(t);
        t += std::max(0.8, 1.9 * way / 0.45);  // 0.45 m/s in the middle of the way
      }
      stops_.push_back({T, t});
    }
    end_s_ = t + 1.0;
  }
  struct Stop {
    Pose T;
    double arrives_s;
  };
  [[nodiscard]] const std::vector<Stop>& stops() const { return stops_; }
  [[nodiscard]] double leaves_s(std::size_t stop) const { return begins_[stop]; }
  [[nodiscard]] Pose at(double t) const {
    for (std::size_t i = 0; i < begins_.size(); ++i) {
      if (t <= begins_[i]) return stops_[i].T;
      if (t < stops_[i + 1].arrives_s) {
        const double s = (t - begins_[i]) / (stops_[i + 1].arrives_s - begins_[i]);
        const double share = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
        const Pose& a = stops_[i].T;
        const Pose& b = stops_[i + 1].T;
        Pose pose = Pose::Identity();
        pose.linear() = Eigen::Quaterniond(a.linear())
                            .slerp(share, Eigen::Quaterniond(b.linear()))
                            .toRotationMatrix();
        pose.translation() = (1.0 - share) * a.translation() + share * b.translation();
        return pose;
      }
    }
    return stops_.back().T;
  }
  [[nodiscard]] CameraTwist twist(double t) const {
    return twist_between(at(t - 0.002), at(t + 0.002), 0.004);
  }

 private:
  std::vector<Stop> stops_;
  std::vector<double> begins_;
  double end_s_ = 0.0;
};

/// What is wrong with a camera, and how it is used.
struct Faults {
  double stamp_offset_s = 0.0;  ///< stamps are later than images by that
  double translation_m = 0.0;
  double rotation_rad = 0.0;
  bool moving = true;  ///< frames on the way
  double hz = 6.0;
};

class FrameAgreementTest : public ::testing::Test {
 protected:
  void travel(const Faults& faults, std::uint64_t seed, int views = 10) {
    RgbdSensorOptions options;
    options.intrinsics = CameraIntrinsics::from_fov(240, 180, 80.0 * kDegree);
    options.noise = sensor_noise_preset("d435");
    options.hand_eye_translation_m = faults.translation_m;
    options.hand_eye_rotation_rad = faults.rotation_rad;
    options.seed = seed;
    const RgbdSensor sensor(*renderer_, scene_, options);
    T_said_true_ = sensor.hand_eye_error();
    const Journey journey(seed, views);
    FrameSample sample;
    std::uint64_t number = 0;
    const auto take = [&](double t) {  // at true time t, with the pose of its stamp
      RgbdFrame frame = sensor.capture(journey.at(t), number++);
      frame.time_s = t + faults.stamp_offset_s;
      frame.T_world_camera = journey.at(frame.time_s);
      return frame;
    };
    const auto& stops = journey.stops();
    for (std::size_t i = 0; i < stops.size(); ++i) {
      sample.rests_from(stops[i].arrives_s);
      sample.add_still(take(stops[i].arrives_s + 0.1));
      if (i + 1 == stops.size()) break;
      sample.moves_from(journey.leaves_s(i));
      const double until = stops[i + 1].arrives_s;
      for (double t = journey.leaves_s(i) + 0.04; faults.moving && t < until;
           t += 1.0 / faults.hz) {
        const RgbdFrame frame = take(t);
        sample.add_moving(frame, journey.twist(frame.time_s));
      }
    }
    const std::clock_t begun = std::clock();
    agreement_ = judge_agreement(sample);
    const double took = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
    std::printf("%2d frames, %2d moving, %.2f s: %s\n", agreement_.frames, agreement_.moving, took,
                agreement_text(agreement_, {}).c_str());
    if (agreement_.estimate) {
      const auto& e = *agreement_.estimate;
      std::printf(
          "   time %.1f (se %.2f) ms, mounting %.2f (se %.2f) mm %.3f (se %.3f) deg; miss "
          "%.2f mm %.3f deg; residual %.2f -> %.2f mm\n",
          1e3 * e.time_offset_s, 1e3 * e.time_offset_se_s, 1e3 * e.translation_m,
          1e3 * e.translation_se_m, e.rotation_rad / kDegree, e.rotation_se_rad / kDegree,
          1e3 * miss_m(), miss_rad() / kDegree, 1e3 * e.all.before_m, 1e3 * e.all.after_m);
    }
  }
  [[nodiscard]] double miss_m() const {
    return (T_said_true_.translation() - agreement_.estimate->T_said_true.translation()).norm();
  }
  [[nodiscard]] double miss_rad() const {
    return Eigen::AngleAxisd(Eigen::Matrix3d(T_said_true_.linear().transpose() *
                                             agreement_.estimate->T_said_true.linear()))
        .angle();
  }

  const Scene scene_ = make_world(std::getenv("W") ? dense_1_world() : scenario_1_world(), 1);
  const std::unique_ptr<Renderer> renderer_ = std::make_unique<Renderer>(scene_);
  Pose T_said_true_ = Pose::Identity();
  FrameAgreement agreement_;
};

TEST_F(FrameAgreementTest, Explore) {
  for (const double offset : {0.0, 0.01, 0.03, -0.06}) {
    for (const std::uint64_t seed : {1, 2}) travel({.stamp_offset_s = offset}, seed);
  }
  std::printf("5 mm\n");
  for (const std::uint64_t seed : {1, 2, 3}) travel({.translation_m = 0.005}, seed);
  std::printf("1 degree\n");
  for (const std::uint64_t seed : {1, 2, 3}) travel({.rotation_rad = kDegree}, seed);
  std::printf("all\n");
  for (const std::uint64_t seed : {1, 2, 3})
    travel({.stamp_offset_s = 0.03, .translation_m = 0.005, .rotation_rad = kDegree}, seed);
  std::printf("still\n");
  travel({.moving = false}, 1);
  std::printf("nothing\n");
  for (std::uint64_t seed = 3; seed < 13; ++seed) travel({}, seed);
}

}  // namespace
}  // namespace canopeer
