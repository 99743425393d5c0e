#include "canopeer/ros2/out/event_words.h"

#include <fmt/format.h>

#include "canopeer/cdr/messages/rcl_interfaces.h"
#include "canopeer/ros2/out/visitors.h"

namespace canopeer::ros {
namespace {

using Level = rcl_interfaces::Log;
using Words = std::optional<EventWords>;

Words words_of_frame(const FrameTaken& e) {
  return EventWords{Level::DEBUG, fmt::format("view {}: {} new voxels, {} fruits", e.view.view,
                                              e.view.realised_gain, e.view.fruits.size())};
}

Words words_of_motion(const MotionEvent& motion) {
  if (motion.collision) return EventWords{Level::ERROR, "the arm collided"};
  if (motion.ended == "arrived") return std::nullopt;
  const bool needs_person = motion.ended == "stopped" || motion.ended == "preempted";
  return EventWords{needs_person ? Level::ERROR : Level::WARN,
                    fmt::format("{} motion {}{}{}", motion.kind, motion.ended,
                                motion.why.empty() ? "" : ": ", motion.why)};
}

Words words_of_steering(const SteeringWord& word) {
  const bool person = word.kind == SteeringWord::Kind::wait_for_person;
  return EventWords{person ? Level::WARN : Level::INFO,
                    fmt::format("told to {} by {}{}{}", steering_name(word.kind), word.by,
                                word.why.empty() ? "" : ": ", word.why)};
}

}  // namespace

namespace {

std::string time_of(double segment_time_s) {
  return segment_time_s > 0.0 ? fmt::format(" of {:.0f} s", segment_time_s) : ", no time limit";
}

}  // namespace

std::optional<EventWords> words_of(const Event& event) {
  return std::visit(
      Visitors{[](const RunBegun& e) -> Words {
                 return EventWords{Level::INFO, fmt::format("the run {}: {} segments{}",
                                                            e.resumed ? "goes on" : "begins",
                                                            e.segments, time_of(e.segment_time_s))};
               },
               [](const SegmentBegun& e) -> Words {
                 return EventWords{Level::INFO, fmt::format("segment {} begins: {}",
                                                            e.segment.segment + 1, e.segment.name)};
               },
               [](const SegmentEnded& e) -> Words {
                 return EventWords{Level::INFO, fmt::format("segment {} ends at {:.1f} s",
                                                            e.segment + 1, e.end_s)};
               },
               [](const FrameTaken& e) { return words_of_frame(e); },
               [](const MotionEnded& e) { return words_of_motion(e.motion); },
               [](const Fault& e) -> Words {
                 return EventWords{Level::FATAL, e.message};
               },
               [](const Steered& e) { return words_of_steering(e.word); },
               [](const RunEnded& e) -> Words {
                 return EventWords{Level::INFO, fmt::format("the run ends at {:.1f} s{}", e.end_s,
                                                            e.interrupted ? ", early" : "")};
               },
               [](const auto&) -> Words { return std::nullopt; }},
      event);
}

}  // namespace canopeer::ros
