#include "canopeer/record/record_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/rng.h"

namespace canopeer {
namespace {

std::filesystem::path fresh_directory(const std::string& name) {
  const std::filesystem::path dir = std::filesystem::path(testing::TempDir()) / ("record_" + name);
  std::filesystem::remove_all(dir);
  return dir;
}

RunHeader some_header() {
  RunHeader header;
  header.canopeer_version = "0.1.0";
  header.mission = "smoke";
  header.planner = "vmp";
  header.seed = 18'000'000'000'000'000'000ULL;
  header.compute_table = "default";
  header.segments = 2;
  header.settings_json = R"({"z":1,"a":{"range_m":[0.3,0.6]}})";
  return header;
}

ViewEvent random_view(Rng& rng, int number) {
  ViewEvent view;
  view.view = number;
  view.segment = number / 3;
  view.t_s = number + rng.uniform();
  for (int joint = 0; joint < 6; ++joint) view.q.push_back(rng.normal());
  view.T_world_camera = look_at(Vec3{rng.normal(), rng.normal(), 1.0}, Vec3(5.0, 5.0, 1.5));
  view.target_kind = "roi";
  if (rng.chance(0.5)) view.predicted_gain = rng.uniform(0.0, 1e4) / 3.0;
  view.realised_gain = static_cast<std::int64_t>(rng.index(100000));
  for (std::uint64_t i = rng.index(4); i > 0; --i) {
    view.fruits.push_back({static_cast<int>(i), Vec3{rng.normal(), rng.normal(), rng.normal()},
                           rng.uniform(10.0, 300.0)});
  }
  return view;
}

/// Six views in two segments, a motion, work, finished; returns the views.
std::vector<ViewEvent> write_some_run(const std::filesystem::path& dir) {
  auto writer = RecordWriter::create(dir, some_header());
  EXPECT_TRUE(writer.has_value());
  Rng rng(7);
  std::vector<ViewEvent> views;
  for (int segment = 0; segment < 2; ++segment) {
    SegmentEvent event{segment,
                       "stop 1, side " + std::to_string(segment + 1),
                       segment * 3.0,
                       0.0,
                       Box(Vec3(-1.19, -1.0 / 3.0, 0.389), Vec3(-0.49, 1.2, 1.489)),
                       Box()};
    EXPECT_TRUE(writer->begin_segment(event));
    for (int i = 0; i < 3; ++i) {
      views.push_back(random_view(rng, 3 * segment + i));
      EXPECT_TRUE(writer->add(views.back()));
    }
    EXPECT_TRUE(writer->end_segment(segment, segment * 3.0 + 3.0));
    EXPECT_TRUE(writer->set_work({{"candidates", 100 * (segment + 1), 0.1}}));
  }
  MotionEvent home;
  home.kind = "home";
  home.segment = 1;
  home.start_s = 6.0;
  home.duration_s = 1.25;
  home.waypoints = {{0.0, 0.1}, {1.0, 0.2}, {1.0, 0.4}};
  home.deviations = {0.0, 0.05, 0.0};
  home.joint_path_rad = 1.1;
  home.ended = "aborted";
  home.why = "a joint left its path";
  EXPECT_TRUE(writer->add(home));
  EXPECT_TRUE(writer->finish(7.5, false));
  return views;
}

TEST(RecordFile, ReadsBackRulesGainsPathsAndTimes) {
  const auto dir = fresh_directory("rules");
  RunHeader header = some_header();
  header.protocol = "views10";
  header.views_planned = 20;
  header.segment_time_s = 0.0;
  auto writer = RecordWriter::create(dir, header);
  ASSERT_TRUE(writer.has_value());
  Rng rng(3);
  ViewEvent view = random_view(rng, 0);
  view.realised_in_fan = 1234;
  ASSERT_TRUE(writer->add(view));
  MotionEvent motion;
  motion.kind = "view";
  motion.camera_path_m = 1.0 / 3.0;
  ASSERT_TRUE(writer->add(motion));
  ASSERT_TRUE(writer->set_time({1.0, 2.0, 0.1, 4.0, 5.0}));
  ASSERT_TRUE(writer->finish(12.1, false));
  const Expected<RunRecord> record = read_record(dir);
  ASSERT_TRUE(record.has_value()) << record.error().message;
  EXPECT_EQ(record->header.protocol, "views10");
  EXPECT_EQ(record->header.views_planned, 20);
  EXPECT_TRUE(record->header.without_time_limit());
  EXPECT_EQ(record->views.at(0).realised_in_fan, 1234);
  EXPECT_EQ(record->motions.at(0).camera_path_m, 1.0 / 3.0);
  ASSERT_TRUE(record->time.has_value());
  EXPECT_EQ(record->time->execution_s, 0.1);
  EXPECT_EQ(record->time->transitions_s, 5.0);
}

TEST(RecordFile, ReadsBackEveryEventExactly) {
  const auto dir = fresh_directory("exact");
  const std::vector<ViewEvent> views = write_some_run(dir);
  const Expected<RunRecord> record = read_record(dir);
  ASSERT_TRUE(record.has_value()) << record.error().message;

  EXPECT_EQ(record->header.seed, some_header().seed);
  EXPECT_EQ(record->header.settings_json, some_header().settings_json);
  ASSERT_EQ(record->segments.size(), 2U);
  EXPECT_EQ(record->segments[1].name, "stop 1, side 2");
  EXPECT_EQ(record->segments[1].end_s, 6.0);
  EXPECT_EQ(record->segments[0].sampling_region_world.min().y(), -1.0 / 3.0);
  EXPECT_TRUE(record->segments[0].workspace_world.isEmpty());
  ASSERT_EQ(record->views.size(), views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ViewEvent& read = record->views[i];
    EXPECT_EQ(read.t_s, views[i].t_s);
    EXPECT_EQ(read.q, views[i].q);
    EXPECT_EQ(read.T_world_camera.matrix(), views[i].T_world_camera.matrix());
    EXPECT_EQ(read.predicted_gain, views[i].predicted_gain);
    EXPECT_EQ(read.realised_gain, views[i].realised_gain);
    ASSERT_EQ(read.fruits.size(), views[i].fruits.size());
    for (std::size_t k = 0; k < read.fruits.size(); ++k) {
      EXPECT_EQ(read.fruits[k].id, views[i].fruits[k].id);
      EXPECT_EQ(read.fruits[k].centre, views[i].fruits[k].centre);
      EXPECT_EQ(read.fruits[k].volume_cm3, views[i].fruits[k].volume_cm3);
    }
  }
  ASSERT_EQ(record->motions.size(), 1U);
  EXPECT_EQ(record->motions[0].waypoints[1][0], 1.0);
  EXPECT_EQ(record->motions[0].deviations, (std::vector<double>{0.0, 0.05, 0.0}));
  EXPECT_EQ(record->motions[0].ended, "aborted");
  EXPECT_EQ(record->motions[0].why, "a joint left its path");
  ASSERT_EQ(record->work.size(), 1U);
  EXPECT_EQ(record->work[0].count, 200);
  EXPECT_EQ(record->end_s, 7.5);
  EXPECT_FALSE(record->interrupted);
}

TEST(RecordFile, SameEventsGiveTheSameBytes) {
  const auto first = fresh_directory("bytes_1");
  const auto second = fresh_directory("bytes_2");
  write_some_run(first);
  write_some_run(second);
  EXPECT_EQ(*read_file(first / "record"), *read_file(second / "record"));
}

TEST(RecordFile, CutAnywhereAfterTheHeaderItReadsAsAnInterruptedRun) {
  const auto dir = fresh_directory("cut");
  write_some_run(dir);
  const std::string whole = *read_file(dir / "record");
  std::size_t views_before = 0;
  for (std::size_t size = whole.find('\n') + 1; size + 1 < whole.size(); size += 37) {
    ASSERT_TRUE(write_file(dir / "record", whole.substr(0, size)));
    const Expected<RunRecord> record = read_record(dir / "record");
    ASSERT_TRUE(record.has_value()) << "cut at " << size << ": " << record.error().message;
    EXPECT_TRUE(record->interrupted) << "cut at " << size;
    EXPECT_GE(record->views.size(), views_before);
    views_before = record->views.size();
    for (const ViewEvent& view : record->views) EXPECT_GE(record->end_s, view.t_s);
    for (const SegmentEvent& segment : record->segments) EXPECT_GE(segment.end_s, 0.0);
  }
  EXPECT_EQ(views_before, 6U);
}

TEST(RecordFile, ErrorsNameFileAndLine) {
  const auto dir = fresh_directory("errors");
  write_some_run(dir);
  const std::string whole = *read_file(dir / "record");
  const std::string header = whole.substr(0, whole.find('\n') + 1);
  const auto error_of = [&](const std::string& content) {
    EXPECT_TRUE(write_file(dir / "record", content));
    const Expected<RunRecord> record = read_record(dir);
    return record ? std::string("no error") : record.error().message;
  };
  EXPECT_NE(
      error_of(header + "{\"view\":{\"segment\":0}}\n").find("record:2: key 'view' not found"),
      std::string::npos);
  EXPECT_NE(error_of(header + "broken\n{}\n").find("record:2: expected one JSON object"),
            std::string::npos);
  EXPECT_NE(error_of("{\"canopeer_record\":99}\n").find("record:1: record format 99"),
            std::string::npos);
  EXPECT_NE(error_of("fruit,x,y\n").find("record:1: this is no run record"), std::string::npos);
  EXPECT_NE(error_of("").find("empty"), std::string::npos);
  EXPECT_FALSE(read_record(dir / "nowhere").has_value());
}

TEST(RecordFile, SkipsEventsAndKeysItDoesNotKnow) {
  const auto dir = fresh_directory("unknown");
  write_some_run(dir);
  const std::string whole = *read_file(dir / "record");
  ASSERT_TRUE(write_file(dir / "record", whole + "{\"weather\":{\"rain\":true}}\n"));
  const Expected<RunRecord> record = read_record(dir);
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->views.size(), 6U);
}

TEST(RecordFile, NumberThatIsNotFiniteReadsAsNan) {
  const auto dir = fresh_directory("nan");
  auto writer = RecordWriter::create(dir, some_header());
  ASSERT_TRUE(writer.has_value());
  ViewEvent view;
  view.q = {1.0, std::numeric_limits<double>::quiet_NaN()};
  ASSERT_TRUE(writer->add(view));
  const Expected<RunRecord> record = read_record(dir);
  ASSERT_TRUE(record.has_value()) << record.error().message;
  EXPECT_TRUE(std::isnan(record->views[0].q[1]));
}

}  // namespace
}  // namespace canopeer
