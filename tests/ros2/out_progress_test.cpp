#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "canopeer/cdr/messages/rcl_interfaces.h"
#include "canopeer/ros2/out/event_words.h"
#include "canopeer/ros2/out/progress.h"

namespace canopeer::ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using rcl_interfaces::Log;

MotionEnded motion_that(const std::string& ended, const std::string& why = "") {
  MotionEvent motion;
  motion.kind = "view";
  motion.start_s = 3.0;
  motion.duration_s = 2.0;
  motion.ended = ended;
  motion.why = why;
  return {motion};
}

Progress begun() {
  Progress progress;
  progress.add(RunBegun{0.0, 6, 60.0, false, {}});
  SegmentEvent segment;
  segment.segment = 1;
  segment.name = "stop 1, side 2";
  segment.start_s = 2.0;
  progress.add(SegmentBegun{segment});
  return progress;
}

TEST(Progress, TellsHowFarTheMissionIs) {
  Progress progress = begun();
  FrameTaken frame;
  frame.view.view = 4;
  frame.view.t_s = 5.5;
  frame.view.roi_voxels = 77;
  frame.view.fruits.resize(3);
  progress.add(frame);
  progress.add(motion_that("arrived"));
  progress.add_loss(2);
  const auto json = nlohmann::json::parse(progress.json());
  EXPECT_EQ(json["state"], "working");
  EXPECT_EQ(json["t_s"], 5.0);
  EXPECT_EQ(json["segment"], 1);
  EXPECT_EQ(json["segments"], 6);
  EXPECT_EQ(json["segment_name"], "stop 1, side 2");
  EXPECT_EQ(json["views"], 5);
  EXPECT_EQ(json["fruits"], 3);
  EXPECT_EQ(json["roi_voxels"], 77);
  EXPECT_EQ(json["last_motion"]["ended"], "arrived");
  EXPECT_EQ(json["lost_events"], 2);
}

TEST(Progress, SaysWhoIsWaitedFor) {
  Progress progress = begun();
  progress.add(Steered{1.0, 0, {SteeringWord::Kind::wait_for_person, "arm", "protective stop"}});
  const auto waits = progress.diagnostics("canopeer");
  EXPECT_EQ(waits[0].name, "canopeer: mission");
  EXPECT_EQ(waits[0].level, DiagnosticStatus::WARN);
  EXPECT_EQ(waits[0].message, "waiting_for_person: protective stop");
  progress.add(Steered{2.0, 0, {SteeringWord::Kind::go_on, "service", ""}});
  EXPECT_EQ(progress.diagnostics("canopeer")[0].level, DiagnosticStatus::OK);
}

TEST(Progress, DiagnosesArmAndFailure) {
  Progress progress = begun();
  EXPECT_EQ(progress.diagnostics("n")[1].message, "not moved yet");
  progress.add(motion_that("aborted", "elbow_joint out of tolerance"));
  EXPECT_EQ(progress.diagnostics("n")[1].level, DiagnosticStatus::WARN);
  EXPECT_EQ(progress.diagnostics("n")[1].message,
            "view motion aborted: elbow_joint out of tolerance");
  progress.add(motion_that("stopped"));
  EXPECT_EQ(progress.diagnostics("n")[1].level, DiagnosticStatus::ERROR);
  progress.add(Fault{9.0, "the camera gave no frame"});
  progress.add(RunEnded{9.0, true});
  EXPECT_EQ(progress.diagnostics("n")[0].level, DiagnosticStatus::ERROR);
  EXPECT_EQ(progress.diagnostics("n")[0].message, "failed: the camera gave no frame");
}

TEST(EventWords, SpeakOfWhatPeopleLookFor) {
  EXPECT_EQ(words_of(Fault{1.0, "no frame"})->level, Log::FATAL);
  EXPECT_EQ(words_of(motion_that("aborted", "why"))->text, "view motion aborted: why");
  EXPECT_EQ(words_of(motion_that("stopped"))->level, Log::ERROR);
  EXPECT_FALSE(words_of(motion_that("arrived")));
  EXPECT_EQ(words_of(RunBegun{0.0, 6, 60.0, false, {}})->text,
            "the run begins: 6 segments of 60 s");
  EXPECT_EQ(words_of(Steered{1.0, 0, {SteeringWord::Kind::pause, "page", "lunch"}})->text,
            "told to pause by page: lunch");
  EXPECT_EQ(words_of(RunEnded{12.34, true})->text, "the run ends at 12.3 s, early");
  EXPECT_FALSE(words_of(MapChanged{}));
}

}  // namespace
}  // namespace canopeer::ros
