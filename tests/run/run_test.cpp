#include "canopeer/run/run.h"

#include <gtest/gtest.h>

#include <atomic>

#include "canopeer/base/atomic_file.h"
#include "canopeer/mission/steering_desk.h"
#include "canopeer/record/record_file.h"
#include "canopeer/sensing/pose_track.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

class RunTest : public ::testing::Test {
 protected:
  void SetUp() override {
    request_.mission = CANOPEER_SOURCE_DIR "/missions/smoke.yaml";
    request_.overrides = {{"time_per_segment_s", "4"}};
    request_.table_dirs = {CANOPEER_SOURCE_DIR "/compute_tables"};
  }
  void TearDown() override { fs::remove_all(out_); }

  fs::path out_ = fs::temp_directory_path() /
                  ("canopeer_run_" +
                   std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  StageRequest request_;
  RunRegistries registries_ = RunRegistries::built_in();
};

/// The simulated glasshouse, but nobody tells what is in it: as on a real robot.
class TightLipped : public Site {
 public:
  explicit TightLipped(std::unique_ptr<Site> site) : site_(std::move(site)) {}
  Ports ports() override { return site_->ports(); }
  const ExactChecker& judge() const override { return site_->judge(); }

 private:
  std::unique_ptr<Site> site_;
};

TEST_F(RunTest, LeavesItsResultsInItsDirectory) {
  const auto run = Run::compose(request_, registries_, out_);
  ASSERT_TRUE(run.has_value()) << run.error().message;
  const auto summary = (*run)->execute();
  ASSERT_TRUE(summary.has_value()) << summary.error().message;
  EXPECT_TRUE((*run)->outcome().has_value());
  EXPECT_FALSE((*run)->interrupted());
  EXPECT_GT(summary->views, 1);
  EXPECT_EQ(summary->fruits_total, 47);
  EXPECT_FALSE(summary->time_offset_s.has_value());  // no frames on the way
  for (const char* file : {"record", "summary.json", "timeline.csv", "fruits.csv", "fruits.ply",
                           "map.ot", "ground_truth.csv", "report.html"}) {
    EXPECT_TRUE(fs::exists(out_ / file)) << file;
  }
}

TEST_F(RunTest, OnASiteThatKnowsNoTruthLeavesScoresOpenAndAReportAllTheSame) {
  ASSERT_TRUE(registries_.sites
                  .add("robot", "keeps its secrets",
                       [](const SiteRequest& request) -> Expected<std::unique_ptr<Site>> {
                         auto site = SiteRegistry::built_in().make("simulation", request);
                         if (!site) return site;
                         return std::make_unique<TightLipped>(std::move(*site));
                       })
                  .has_value());
  request_.site = "robot";
  const auto run = Run::compose(request_, registries_, out_);
  ASSERT_TRUE(run.has_value()) << run.error().message;
  const auto summary = (*run)->execute();
  ASSERT_TRUE(summary.has_value()) << summary.error().message;
  EXPECT_FALSE(summary->fruits_total.has_value());
  EXPECT_FALSE(summary->auc.has_value());
  EXPECT_GT(summary->joint_path_length_rad, 0.0);
  EXPECT_FALSE(fs::exists(out_ / "ground_truth.csv"));
  EXPECT_TRUE(fs::exists(out_ / "report.html"));
  EXPECT_FALSE((*run)->state().has_value());  // such a site cannot be put back
}

/// A robot that stands for the simulated one: its own clock, a slow arm, somebody who watches and
/// steers.
class ManneredSite : public TightLipped {
 public:
  struct Seen : Watcher {
    void on_event(const Event&) override { ++events; }
    std::atomic<int> events{0};
  };
  ManneredSite(std::unique_ptr<Site> site, std::shared_ptr<Seen> seen, fs::path& results)
      : TightLipped(std::move(site)), seen_(std::move(seen)), results_(results) {}
  std::shared_ptr<Watcher> watcher() override { return seen_; }
  Steering* steering() override { return &stop_; }
  void results_in(const fs::path& out) override { results_ = out; }

 private:
  std::shared_ptr<Seen> seen_;
  fs::path& results_;
  SteeringPolicy stop_{"the site", [](const SteeringPoint& point) {
                         return point.views > 0 ? SteeringWord::Kind::stop
                                                : SteeringWord::Kind::go_on;
                       }};
};

TEST_F(RunTest, OnASiteWithMannersTakesThemOn) {
  const auto seen = std::make_shared<ManneredSite::Seen>();
  fs::path results;
  SiteManners manners;
  manners.realtime = true;
  manners.arm_speed = [](const MissionFile&) { return 0.5; };
  ASSERT_TRUE(registries_.sites
                  .add_with_manners(
                      "robot", "stops after a view",
                      [&](const SiteRequest& request) -> Expected<std::unique_ptr<Site>> {
                        auto site = SiteRegistry::built_in().make("simulation", request);
                        if (!site) return site;
                        return std::make_unique<ManneredSite>(std::move(*site), seen, results);
                      },
                      std::move(manners))
                  .has_value());
  request_.site = "robot";
  const auto run = Run::compose(request_, registries_, out_);
  ASSERT_TRUE(run.has_value()) << run.error().message;
  request_.site = "simulation";
  const auto simulated = Stage::make(request_, registries_);
  ASSERT_TRUE(simulated.has_value());
  const JointLimits& slow = (*run)->stage().robot().model.limits();
  const JointLimits& quick = (*simulated)->robot().model.limits();
  EXPECT_EQ(slow.velocity, 0.5 * quick.velocity);
  EXPECT_EQ(slow.acceleration, 0.25 * quick.acceleration);
  EXPECT_EQ(slow.upper, quick.upper);
  SteeringPolicy nobody("nobody", [](const SteeringPoint&) { return SteeringWord::Kind::go_on; });
  (*run)->steer(nobody);
  ASSERT_TRUE((*run)->execute().has_value());
  EXPECT_TRUE((*run)->interrupted());
  EXPECT_EQ((*run)->record().steering.back().by, "the site");
  EXPECT_GT(seen->events, 2);
  EXPECT_EQ(results, out_);
}

/// Stamps its frames on the way late, and so has the pose of where it went meanwhile.
class LateCamera : public Camera {
 public:
  static constexpr double kLate_s = 0.03;
  explicit LateCamera(Camera& camera) : camera_(camera) {}
  Expected<RgbdFrame> capture() override { return camera_.capture(); }
  Expected<void> stream(double hz) override { return camera_.stream(hz); }
  Expected<std::vector<StreamedFrame>> arrived() override {
    auto frames = camera_.arrived();
    if (!frames) return frames;
    for (StreamedFrame& f : *frames) {
      const PoseTrack track({{f.time_s, f.T_world_camera, f.twist}});
      f.time_s += kLate_s;
      f.T_world_camera = *track.at(f.time_s);
      f.images = [images = f.images, t = f.time_s, T = f.T_world_camera]() -> Expected<RgbdFrame> {
        auto frame = images();
        if (!frame) return frame;
        frame->time_s = t;
        frame->T_world_camera = T;
        return frame;
      };
    }
    return frames;
  }

 private:
  Camera& camera_;
};

class LateSite : public TightLipped {
 public:
  explicit LateSite(std::unique_ptr<Site> site)
      : TightLipped(std::move(site)), camera_(*TightLipped::ports().camera) {}
  Ports ports() override {
    Ports ports = TightLipped::ports();
    ports.camera = &camera_;
    return ports;
  }

 private:
  LateCamera camera_;
};

TEST_F(RunTest, SaysWhetherPoseAndImageAgreeWhereFramesComeOnTheWay) {
  ASSERT_TRUE(registries_.sites
                  .add("late", "a camera whose stamps are late",
                       [](const SiteRequest& request) -> Expected<std::unique_ptr<Site>> {
                         auto site = SiteRegistry::built_in().make("simulation", request);
                         if (!site) return site;
                         return std::make_unique<LateSite>(std::move(*site));
                       })
                  .has_value());
  request_.overrides = {
      {"time_per_segment_s", "15"}, {"frames.on_the_way_hz", "10"}, {"frames.max_blur_px", "0"}};
  for (const std::string site : {"simulation", "late"}) {
    std::vector<std::string> said;
    request_.site = site;
    request_.callbacks.on_message = [&](const std::string& text) { said.push_back(text); };
    const auto run = Run::compose(request_, registries_, out_);
    ASSERT_TRUE(run.has_value()) << run.error().message;
    const auto summary = (*run)->execute();
    ASSERT_TRUE(summary.has_value()) << summary.error().message;
    ASSERT_TRUE(summary->time_offset_s.has_value());
    const bool late = site == "late";
    EXPECT_NEAR(*summary->time_offset_s, late ? -LateCamera::kLate_s : 0.0, 0.008) << site;
    EXPECT_EQ(said.size(), late ? 1U : 0U);
  }
}

TEST_F(RunTest, NamesTheSitesThereAreWhenAskedForAnother) {
  request_.site = "mars";
  const auto run = Run::compose(request_, registries_, out_);
  ASSERT_FALSE(run.has_value());
  EXPECT_NE(run.error().message.find("mars"), std::string::npos);
  EXPECT_NE(run.error().message.find("simulation"), std::string::npos);
}

TEST_F(RunTest, RefusesASiteThatHasNoPortsOrWhoseClockIsAnother) {
  const auto add = [&](const char* name, SiteRegistry::Factory factory) {
    ASSERT_TRUE(registries_.sites.add(name, "", std::move(factory)).has_value());
  };
  add("nothing", [](const SiteRequest&) -> Expected<std::unique_ptr<Site>> {
    return std::unique_ptr<Site>();
  });
  request_.site = "nothing";
  auto run = Run::compose(request_, registries_, out_);
  ASSERT_FALSE(run.has_value());
  EXPECT_NE(run.error().message.find("site 'nothing': a port is missing"), std::string::npos);
  add("simulated", [](const SiteRequest& request) -> Expected<std::unique_ptr<Site>> {
    MissionFile file = request.file;
    file.simulation.realtime = false;
    auto site = SiteRegistry::built_in().make("simulation", {file, request.robot});
    if (!site) return site;
    return std::make_unique<TightLipped>(std::move(*site));
  });
  request_.site = "simulated";
  request_.realtime = true;
  run = Run::compose(request_, registries_, out_);
  ASSERT_FALSE(run.has_value());
  EXPECT_NE(run.error().message.find("without --realtime"), std::string::npos);
}

TEST_F(RunTest, SaysNoToCallsOutOfOrder) {
  const auto run = Run::compose(request_, registries_, out_);
  ASSERT_TRUE(run.has_value());
  EXPECT_FALSE((*run)->state().has_value());
  EXPECT_FALSE((*run)->finish().has_value());
  ASSERT_TRUE((*run)->begin().has_value());
  EXPECT_FALSE((*run)->begin().has_value());
  ASSERT_TRUE((*run)->step());
  EXPECT_TRUE((*run)->state().has_value());
  ASSERT_TRUE((*run)->finish().has_value());
  EXPECT_TRUE((*run)->interrupted());
  EXPECT_FALSE((*run)->finish().has_value());
  EXPECT_FALSE((*run)->state().has_value());
  // The record ends once.
  const auto record = read_record(out_);
  ASSERT_TRUE(record.has_value());
  EXPECT_TRUE(record->interrupted);
}

/// Wants everything, and takes its time.
class Onlooker : public Watcher {
 public:
  EventNeeds needs() const override { return {true, true}; }
  void on_event(const Event& event) override {
    if (const auto* change = std::get_if<MapChanged>(&event)) maps.push_back(change->map);
  }
  std::vector<std::shared_ptr<const VoxelMap>> maps;
};

TEST_F(RunTest, GivesTheSameBytesWithAndWithoutWatchers) {
  const auto alone = Run::compose(request_, registries_, out_ / "alone");
  ASSERT_TRUE((*alone)->execute().has_value());
  const auto watched = Run::compose(request_, registries_, out_ / "watched");
  const auto onlooker = std::make_shared<Onlooker>();
  (*watched)->watch(onlooker, {.name = "onlooker", .queue = 2, .wait_in_simulated_time = true});
  ASSERT_TRUE((*watched)->execute().has_value());
  for (const char* file : {"record", "fruits.csv", "map.ot"}) {
    EXPECT_TRUE(read_file(out_ / "alone" / file).value() ==
                read_file(out_ / "watched" / file).value())
        << file;
  }
  EXPECT_FALSE(onlooker->maps.empty());
}

TEST_F(RunTest, OnTheWallClockDoesTheSameJob) {
  request_.realtime = true;
  request_.overrides = {{"time_per_segment_s", "2"}};
  const auto run = Run::compose(request_, registries_, out_);
  ASSERT_TRUE(run.has_value()) << run.error().message;
  const auto summary = (*run)->execute();
  ASSERT_TRUE(summary.has_value()) << summary.error().message;
  EXPECT_EQ(summary->compute_table, "wall-clock");
  EXPECT_GE(summary->views, 1);
  const auto state = (*run)->state();
  EXPECT_FALSE(state.has_value());
}

}  // namespace
}  // namespace canopeer
