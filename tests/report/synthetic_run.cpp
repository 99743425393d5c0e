#include "synthetic_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/rng.h"
#include "canopeer/eval/metrics.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/record/record_file.h"
#include "canopeer/record/summary.h"
#include "canopeer/record/timeline_csv.h"
#include "canopeer/sensing/png.h"

namespace canopeer::testing_support {
namespace {

std::vector<FruitTruth> some_truth(Rng& rng) {
  std::vector<FruitTruth> truth;
  for (int id = 0; id < 53; ++id) {
    FruitTruth fruit;
    fruit.id = id;
    fruit.plant = static_cast<int>(rng.index(12));
    fruit.ripeness =
        id < 47 ? (rng.chance(0.3) ? Ripeness::turning : Ripeness::ripe) : Ripeness::green;
    fruit.counted = id < 47;
    const double row_x = fruit.plant < 6 ? -0.75 : 0.75;
    fruit.centre = {row_x + rng.normal(0.0, 0.1),
                    -1.25 + 0.5 * (fruit.plant % 6) + rng.normal(0.0, 0.08),
                    rng.uniform(0.25, 1.15)};
    fruit.diameter_m = rng.uniform(0.06, 0.085);
    fruit.length_m = rng.uniform(0.07, 0.1);
    fruit.volume_cm3 =
        1e6 * std::numbers::pi / 6.0 * fruit.length_m * fruit.diameter_m * fruit.diameter_m;
    fruit.surface_cm2 = 1e4 * std::numbers::pi * fruit.length_m * fruit.diameter_m;
    truth.push_back(fruit);
  }
  return truth;
}

std::string truth_csv(const std::vector<FruitTruth>& truth) {
  std::string csv =
      "id,class,counted,x_m,y_m,z_m,length_m,diameter_m,volume_cm3,surface_cm2,plant\n";
  for (const FruitTruth& f : truth) {
    const char* name = f.ripeness == Ripeness::ripe      ? "ripe"
                       : f.ripeness == Ripeness::turning ? "turning"
                                                         : "green";
    csv += std::to_string(f.id) + "," + name + "," + (f.counted ? "1" : "0");
    for (const double value : {f.centre.x(), f.centre.y(), f.centre.z(), f.length_m, f.diameter_m,
                               f.volume_cm3, f.surface_cm2}) {
      csv += "," + std::to_string(value);
    }
    csv += "," + std::to_string(f.plant) + "\n";
  }
  return csv;
}

FruitEstimate estimate_of(const FruitTruth& truth, Rng& rng) {
  FruitEstimate fruit;
  const double error_m = rng.chance(0.12) ? 0.05 : 0.012;
  fruit.centre = truth.centre + error_m * Vec3{rng.normal(), rng.normal(), rng.normal()};
  fruit.semi_axes_m =
      0.5 * Vec3(truth.diameter_m, truth.diameter_m, truth.length_m) * rng.uniform(0.75, 1.15);
  fruit.roll_pitch_yaw_rad = {rng.normal(0.0, 0.3), rng.normal(0.0, 0.3), rng.uniform(-3.0, 3.0)};
  fruit.volume_cm3 = 1e6 * 4.0 / 3.0 * std::numbers::pi * fruit.semi_axes_m.prod();
  fruit.points = 60 + static_cast<int>(rng.index(400));
  fruit.confidence = rng.uniform(0.3, 1.0);
  return fruit;
}

/// Every fruit appears in the segment whose side and stop it is near.
struct Appearance {
  FruitEstimate fruit;
  int segment = 0;
  double after_s = 0.0;
};

int segment_of(const Vec3& p) {
  const int stop = std::clamp(static_cast<int>(std::floor((p.y() + 1.5) / 0.75)), 0, 3);
  return 2 * stop + (p.x() < 0.0 ? 0 : 1);
}

std::vector<Appearance> appearances(const std::vector<FruitTruth>& truth, Rng& rng) {
  std::vector<Appearance> all;
  for (const FruitTruth& fruit : truth) {
    if (rng.chance(fruit.counted ? 0.18 : 0.7)) continue;
    all.push_back({estimate_of(fruit, rng), segment_of(fruit.centre), 60.0 * rng.uniform()});
  }
  for (int i = 0; i < 3; ++i) {
    FruitTruth ghost;
    ghost.centre = {rng.chance(0.5) ? 0.9 : -0.9, rng.uniform(-1.3, 1.3), rng.uniform(0.3, 1.1)};
    ghost.diameter_m = ghost.length_m = 0.06;
    all.push_back({estimate_of(ghost, rng), segment_of(ghost.centre), 60.0 * rng.uniform()});
  }
  for (std::size_t i = 0; i < all.size(); ++i) all[i].fruit.id = static_cast<int>(i);
  return all;
}

ColorImage some_picture(int width, int height) {
  ColorImage image(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      image.at(u, v) = {static_cast<std::uint8_t>(60 + 60 * u / width),
                        static_cast<std::uint8_t>(90 + 90 * v / height), 70};
    }
  }
  return image;
}

constexpr double kWholeS = 63.0;  // a segment's share of T

class SyntheticRun {
 public:
  SyntheticRun(const std::filesystem::path& dir, const SyntheticRunOptions& options)
      : dir_(dir), options_(options), rng_(options.seed), truth_(some_truth(rng_)) {
    if (options.fruits) coming_ = appearances(truth_, rng_);
    RunHeader header;
    header.canopeer_version = "0.1.0";
    header.mission = "synthetic <row>";
    header.planner = "vmp";
    header.seed = options.seed;
    header.compute_table = "default";
    header.segments = options.segments;
    if (options.on_the_way) header.mission_time_s = kWholeS * options.segments;
    header.settings_json =
        R"({"planner":{"k_nearest":5,"look_ahead_rad":5.0},"map":{"resolution_m":0.01}})";
    auto writer = RecordWriter::create(dir, header);
    EXPECT_TRUE(writer.has_value());
    writer_ = std::make_unique<RecordWriter>(std::move(*writer));
  }

  void run() {
    const int begun = options_.interrupted ? options_.segments / 2 + 1 : options_.segments;
    for (int segment = 0; segment < begun; ++segment) {
      run_segment(segment, options_.interrupted && segment + 1 == begun ? 25.0 : 60.0);
    }
    if (!options_.interrupted) {
      EXPECT_TRUE(writer_->finish(t_s_, false));
    }
    leave_files();
  }

 private:
  void run_segment(int segment, double length_s) {
    const double begin_s = t_s_;
    segment_begin_s_ = begin_s;
    EXPECT_TRUE(writer_->begin_segment(
        {segment,
         "stop " + std::to_string(segment / 2 + 1) + ", side " + std::to_string(segment % 2 + 1),
         begin_s, 0.0, Box(), Box()}));
    while (t_s_ - begin_s < length_s) take_view(segment, begin_s);
    if (length_s < 60.0) return;  // interrupted: no end of the segment
    EXPECT_TRUE(writer_->end_segment(segment, t_s_));
    EXPECT_TRUE(
        writer_->set_work({{"fused points", 260'000LL * (segment + 1), 9.1 * (segment + 1)},
                           {"view candidates", 9'400LL * (segment + 1), 4.2 * (segment + 1)},
                           {"edge checks", 21'000LL * (segment + 1), 6.3 * (segment + 1)},
                           {"view evaluations", 3'100LL * (segment + 1), 0.4 * (segment + 1)},
                           {"search expansions", 900LL * (segment + 1), 0.2 * (segment + 1)}}));
    EXPECT_TRUE(writer_->add(motion("home", segment, t_s_, 2.0, 3.1)));
    t_s_ += 4.5;
  }

  MotionEvent motion(const char* kind, int segment, double start_s, double duration_s,
                     double path_rad) {
    MotionEvent motion;
    if (options_.on_the_way) motion.frames = look_around(kind, segment, start_s, duration_s);
    motion.kind = kind;
    motion.segment = segment;
    motion.start_s = start_s;
    motion.duration_s = duration_s;
    motion.joint_path_rad = path_rad;
    return motion;
  }

  /// Two frames in a motion; the first is taken in.
  FrameCounts look_around(const char* kind, int segment, double start_s, double duration_s) {
    FrameEvent frame;
    frame.segment = segment;
    frame.during = kind;
    frame.t_s = start_s + 0.5 * duration_s;
    frame.blur_px = 0.1 + 0.001 * (views_ % 900);
    frame.realised_gain = 100;
    frame.T_world_camera.translation() = Vec3(0.0, -1.3 + 0.01 * views_, 1.0);
    frame.fruits = fruits_at(segment, frame.t_s - segment_begin_s_);
    EXPECT_TRUE(writer_->add(frame));
    return {.fused = 1, .late = 0, .blurred = 1, .alike = 0, .unread = 0};
  }

  [[nodiscard]] std::vector<FruitSnapshot> fruits_at(int segment, double into_s) const {
    std::vector<FruitSnapshot> fruits;
    for (const Appearance& a : coming_) {
      if (a.segment < segment || (a.segment == segment && a.after_s <= into_s)) {
        fruits.push_back({a.fruit.id, a.fruit.centre, a.fruit.volume_cm3});
      }
    }
    return fruits;
  }

  void take_view(int segment, double begin_s) {
    ViewEvent view;
    view.segment = segment;
    view.view = views_++;
    view.planning_s = rng_.uniform(0.02, 0.3);
    view.motion_s = 0.4 + std::exp(rng_.normal(0.1, 0.55));
    EXPECT_TRUE(writer_->add(motion("view", segment, t_s_ + view.planning_s, view.motion_s, 1.4)));
    t_s_ += view.planning_s + view.motion_s + 0.06;
    view.t_s = t_s_;
    view.target_kind = "roi";
    view.predicted_gain = rng_.uniform(100.0, 9000.0);
    view.realised_gain = static_cast<std::int64_t>(*view.predicted_gain * rng_.uniform(0.4, 1.1));
    view.T_world_camera.translation() =
        Vec3{rng_.uniform(-0.35, 0.3), -1.3 + 0.8 * (segment / 2) + rng_.uniform(-0.5, 0.5),
             rng_.uniform(0.7, 1.6)};
    view.fused_points = 200'000;
    view.fruits = fruits_at(segment, t_s_ - begin_s);
    view.roi_voxels = static_cast<std::int64_t>(view.fruits.size()) * 190;
    view.graph_nodes = 800;
    view.graph_edges = 2100;
    EXPECT_TRUE(writer_->add(view));
    last_ = view;
  }

  void leave_files() {
    std::vector<FruitEstimate> fruits;
    for (const Appearance& a : coming_) {
      const auto seen = [&](const FruitSnapshot& s) { return s.id == a.fruit.id; };
      if (std::any_of(last_.fruits.begin(), last_.fruits.end(), seen)) fruits.push_back(a.fruit);
    }
    const Expected<RunRecord> record = read_record(dir_);
    ASSERT_TRUE(record.has_value()) << record.error().message;
    ASSERT_TRUE(write_file(dir_ / "fruits.csv", fruits_csv(fruits)));
    ASSERT_TRUE(write_file(dir_ / "timeline.csv", timeline_csv(*record)));
    if (options_.truth) {
      ASSERT_TRUE(write_file(dir_ / "ground_truth.csv", truth_csv(truth_)));
    }
    ASSERT_TRUE(write_summary(dir_ / "summary.json", summary_of(*record, fruits)));
    std::filesystem::create_directories(dir_ / "pictures");
    ASSERT_TRUE(write_png(dir_ / "pictures" / "01_row_from_above.png", some_picture(640, 360)));
    ASSERT_TRUE(write_png(dir_ / "pictures" / "02_first_view.png", some_picture(640, 360)));
  }

  [[nodiscard]] Summary summary_of(const RunRecord& record,
                                   const std::vector<FruitEstimate>& fruits) const {
    Summary s = canopeer::summary_of(record);
    s.wall_time_s = 148.3;
    s.roi_voxels = last_.roi_voxels;
    s.fruits_reported = static_cast<int>(fruits.size());
    if (options_.truth) {
      static_cast<RunScores&>(s) = compute_metrics(record, fruits, truth_);
    }
    s.plant_contacts = 2;
    return s;
  }

  std::filesystem::path dir_;
  SyntheticRunOptions options_;
  Rng rng_;
  std::vector<FruitTruth> truth_;
  std::vector<Appearance> coming_;
  std::unique_ptr<RecordWriter> writer_;
  double t_s_ = 0.0;
  double segment_begin_s_ = 0.0;
  int views_ = 0;
  ViewEvent last_;
};

}  // namespace

void write_synthetic_run(const std::filesystem::path& run_dir, const SyntheticRunOptions& options) {
  std::filesystem::remove_all(run_dir);
  SyntheticRun(run_dir, options).run();
}

}  // namespace canopeer::testing_support
