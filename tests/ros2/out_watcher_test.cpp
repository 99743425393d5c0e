#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ball_scene.h"
#include "canopeer/cdr/messages/diagnostic_msgs.h"
#include "canopeer/cdr/messages/rcl_interfaces.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/map/map_file.h"
#include "canopeer/ros2/out/ros2_watcher.h"
#include "canopeer/ros2/out/told_topics.h"
#include "canopeer/run/run.h"
#include "heard.h"

namespace canopeer::ros {
namespace {

namespace fs = std::filesystem;
using testing_support::eventually;
using testing_support::make_node;

class Ros2WatcherTest : public ::testing::Test {
 protected:
  std::shared_ptr<Ros2Watcher> watcher(const Ros2OutputSettings& settings = {}) {
    return must(Ros2Watcher::make({node_, clock_, settings, "camera_optical_frame"}));
  }

  std::shared_ptr<Node> node_ = make_node("canopeer");
  std::unique_ptr<Node> viewer_ = make_node("viewer");
  std::shared_ptr<RosClock> clock_ = std::make_shared<RosClock>();
};

MapChanged a_map(std::uint64_t seed = 1) {
  MapChanged event;
  event.map = std::make_shared<const VoxelMap>(BallScene::map(seed, 1));
  return event;
}

FruitsFound two_fruits() {
  FruitsFound event;
  event.fruits.resize(2);
  for (int i = 0; i < 2; ++i) {
    event.fruits[static_cast<std::size_t>(i)].id = i;
    event.fruits[static_cast<std::size_t>(i)].semi_axes_m = {0.03, 0.03, 0.04};
  }
  return event;
}

FrameTaken a_frame() {
  FrameTaken event;
  auto frame = std::make_shared<RgbdFrame>();
  frame->intrinsics = CameraIntrinsics::from_fov(8, 6, 1.0);
  frame->color = ColorImage(8, 6);
  event.frame = frame;
  return event;
}

TEST_F(Ros2WatcherTest, WhoComesLateSeesHowThingsAre) {
  const auto told = watcher();
  const MapChanged map = a_map();
  told->on_event(map);
  told->on_event(two_fruits());
  told->on_event(a_frame());

  const Heard<sensor_msgs::PointCloud2> occupied(*viewer_, "/canopeer/occupied_voxels");
  const Heard<sensor_msgs::PointCloud2> roi(*viewer_, "/canopeer/roi_voxels");
  const Heard<octomap_msgs::Octomap> binary(*viewer_, "/canopeer/octomap_binary");
  const Heard<octomap_msgs::Octomap> full(*viewer_, "/canopeer/octomap_full");
  const Heard<vision_msgs::Detection3DArray> fruits(*viewer_, "/canopeer/fruits");
  const Heard<visualization_msgs::MarkerArray> markers(*viewer_, "/canopeer/fruit_markers");
  const Heard<visualization_msgs::Marker> frustum(*viewer_, "/canopeer/frustum");
  const Heard<sensor_msgs::Image> picture(*viewer_, "/canopeer/detections");
  ASSERT_TRUE(occupied.comes());
  EXPECT_EQ(occupied.last()->width, map.map->occupied_voxels());
  EXPECT_EQ(occupied.last()->header.frame_id, "map");
  ASSERT_TRUE(roi.comes());
  EXPECT_EQ(roi.last()->width, map.map->roi_voxels());
  EXPECT_TRUE(binary.comes());
  EXPECT_TRUE(full.comes());
  ASSERT_TRUE(fruits.comes());
  EXPECT_EQ(fruits.last()->detections.size(), 2u);
  ASSERT_TRUE(markers.comes());
  EXPECT_EQ(markers.last()->markers.size(), 5u);
  EXPECT_TRUE(frustum.comes());
  ASSERT_TRUE(picture.comes());
  EXPECT_EQ(picture.last()->header.frame_id, "camera_optical_frame");
}

TEST_F(Ros2WatcherTest, TellsTheNewestAtTheEndWhateverTheRate) {
  Ros2OutputSettings rarely;
  rarely.map_rate_hz = 0.01;
  const auto told = watcher(rarely);
  const Heard<sensor_msgs::PointCloud2> occupied(*viewer_, "/canopeer/occupied_voxels");
  told->on_event(a_map(1));
  ASSERT_TRUE(occupied.comes());
  const MapChanged newest = a_map(5);
  told->on_event(newest);
  told->on_event(RunEnded{3.0, false});
  EXPECT_TRUE(occupied.comes_to(
      [&](const auto& cloud) { return cloud.width == newest.map->occupied_voxels(); }));
}

TEST_F(Ros2WatcherTest, SpeaksOfProgressFaultsAndDiagnoses) {
  const auto told = watcher();
  const Heard<std_msgs::String> progress(*viewer_, "/canopeer/progress");
  const Heard<rcl_interfaces::Log> log(*viewer_, "/rosout", Qos{true, true, 100});
  const Heard<diagnostic_msgs::DiagnosticArray> diagnostics(*viewer_, "/diagnostics", kDefaultQos);
  told->on_event(RunBegun{0.0, 6, 60.0, false, {}});
  EXPECT_TRUE(log.comes_to([](const auto& line) {
    return line.msg == "the run begins: 6 segments of 60 s" && line.name == "canopeer";
  }));
  told->on_event(Fault{2.0, "the camera gave no frame"});
  EXPECT_TRUE(log.comes_to([](const auto& line) {
    return line.level == rcl_interfaces::Log::FATAL && line.msg == "the camera gave no frame";
  }));
  EXPECT_TRUE(progress.comes_to(
      [](const auto& text) { return nlohmann::json::parse(text.data)["state"] == "failed"; }));
  EXPECT_TRUE(diagnostics.comes_to([](const auto& array) {
    return array.status.size() == 5 && array.status[0].level == 2 &&
           array.status[4].name == "canopeer: network";
  }));
}

TEST_F(Ros2WatcherTest, SavesWhatIsKnownNow) {
  const fs::path folder = fs::path(::testing::TempDir()) / "canopeer_saved";
  fs::remove_all(folder);
  const auto told = watcher();
  EXPECT_FALSE(told->save(folder));
  const MapChanged map = a_map();
  told->on_event(map);
  told->on_event(two_fruits());
  const auto written = told->save(folder);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(written->size(), 4u);
  const auto read = read_map(folder / "map.ot");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->map.observed_voxels(), map.map->observed_voxels());
  EXPECT_EQ(read->map.roi_voxels(), map.map->roi_voxels());
  EXPECT_EQ(must(read_fruits_csv(folder / "fruits.csv")).size(), 2u);
  fs::remove_all(folder);
}

TEST_F(Ros2WatcherTest, MakesNothingThatNobodyReads) {
  ToldTopic<std_msgs::String> topic;
  ASSERT_TRUE(topic.open(*node_, "~/unread"));
  int made = 0;
  topic.offer([&] {
    ++made;
    return std_msgs::String{"news"};
  });
  topic.tell(std::chrono::steady_clock::now());
  EXPECT_EQ(made, 0);
  const Heard<std_msgs::String> reader(*viewer_, "/canopeer/unread");
  ASSERT_TRUE(eventually([&] {
    topic.tell_if_due(std::chrono::steady_clock::now(), 1.0);
    return made == 1;
  }));
  ASSERT_TRUE(reader.comes());
  topic.tell(std::chrono::steady_clock::now());  // it is not new any more
  EXPECT_EQ(made, 1);
}

TEST_F(Ros2WatcherTest, FollowsAWholeMission) {
  StageRequest request;
  request.mission = CANOPEER_SOURCE_DIR "/missions/smoke.yaml";
  request.overrides = {{"time_per_segment_s", "4"}};
  request.table_dirs = {CANOPEER_SOURCE_DIR "/compute_tables"};
  const fs::path out = fs::path(::testing::TempDir()) / "canopeer_watched_run";
  const auto run = must(Run::compose(request, RunRegistries::built_in(), out));
  const auto told = watcher();
  run->watch(told);
  const Heard<std_msgs::String> progress(*viewer_, "/canopeer/progress");
  const Heard<vision_msgs::Detection3DArray> fruits(*viewer_, "/canopeer/fruits");
  const Heard<visualization_msgs::MarkerArray> graph(*viewer_, "/canopeer/graph");
  const Heard<nav_msgs::Path> path(*viewer_, "/canopeer/path");
  const Heard<sensor_msgs::PointCloud2> roi(*viewer_, "/canopeer/roi_voxels");
  const auto summary = must(run->execute());
  EXPECT_TRUE(progress.comes_to([&](const auto& text) {
    const auto json = nlohmann::json::parse(text.data);
    return json["state"] == "ended" && json["views"] == summary.views && json["lost_events"] == 0;
  }));
  EXPECT_TRUE(fruits.comes_to([&](const auto& array) {
    return static_cast<int>(array.detections.size()) == summary.fruits_reported;
  }));
  EXPECT_TRUE(roi.comes_to([&](const auto& cloud) { return cloud.width == summary.roi_voxels; }));
  ASSERT_TRUE(graph.comes());
  EXPECT_GT(graph.last()->markers[0].points.size(), 10u);
  ASSERT_TRUE(path.comes());
  EXPECT_GE(path.last()->poses.size(), 1u);
  fs::remove_all(out);
}

}  // namespace
}  // namespace canopeer::ros
