#include "canopeer/ros2/out/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "canopeer/ros2/out/visitors.h"

namespace canopeer::ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using ProgressJson = nlohmann::ordered_json;

DiagnosticStatus status_of(const std::string& name, std::uint8_t level, std::string message) {
  DiagnosticStatus status;
  status.name = name;
  status.level = level;
  status.message = std::move(message);
  return status;
}

template <class Value>
void add_value(DiagnosticStatus& status, const std::string& key, const Value& value) {
  status.values.push_back({key, fmt::format("{}", value)});
}

}  // namespace

const char* Progress::name_of(State state) {
  switch (state) {
    case State::waiting:
      return "waiting";
    case State::working:
      return "working";
    case State::moving:
      return "moving";
    case State::paused:
      return "paused";
    case State::waiting_for_person:
      return "waiting_for_person";
    case State::ended:
      return "ended";
    case State::failed:
      return "failed";
  }
  return "working";
}

void Progress::add(const Event& event) {
  std::visit(Visitors{[&](const RunBegun& e) {
                        t_s_ = e.t_s;
                        segments_ = e.segments;
                        segment_time_s_ = e.segment_time_s;
                        if (e.segment) segment_ = *e.segment;
                        state_ = State::working;
                      },
                      [&](const SegmentBegun& e) {
                        t_s_ = e.segment.start_s;
                        segment_ = e.segment;
                      },
                      [&](const SegmentEnded& e) { t_s_ = e.end_s; },
                      [&](const FrameTaken& e) {
                        t_s_ = last_view_s_ = e.view.t_s;
                        views_ = e.view.view + 1;
                        fused_points_ += e.view.fused_points;
                        roi_voxels_ = e.view.roi_voxels;
                        graph_nodes_ = e.view.graph_nodes;
                        graph_edges_ = e.view.graph_edges;
                        fruits_ = static_cast<int>(e.view.fruits.size());
                      },
                      [&](const FrameOnTheWay& e) {
                        t_s_ = e.frame.t_s;
                        fused_points_ += e.frame.fused_points;
                        fruits_ = static_cast<int>(e.frame.fruits.size());
                      },
                      [&](const MapChanged& e) { t_s_ = e.t_s; },
                      [&](const FruitsFound& e) {
                        t_s_ = e.t_s;
                        fruits_ = static_cast<int>(e.fruits.size());
                      },
                      [&](const Planned& e) { t_s_ = e.t_s; },
                      [&](const MotionBegun& e) {
                        t_s_ = e.start_s;
                        state_ = State::moving;
                      },
                      [&](const MotionEnded& e) {
                        t_s_ = e.motion.start_s + e.motion.duration_s;
                        if (state_ == State::moving) state_ = State::working;
                        motion_ = e.motion;
                        ++motions_;
                        if (motion_.ended != "arrived") ++missed_motions_;
                      },
                      [&](const Fault& e) {
                        t_s_ = e.t_s;
                        state_ = State::failed;
                        why_ = e.message;
                      },
                      [&](const Steered& e) {
                        t_s_ = e.t_s;
                        why_ = e.word.why;
                        if (e.word.kind == SteeringWord::Kind::pause) state_ = State::paused;
                        if (e.word.kind == SteeringWord::Kind::wait_for_person) {
                          state_ = State::waiting_for_person;
                        }
                        if (e.word.kind < SteeringWord::Kind::pause ||
                            e.word.kind == SteeringWord::Kind::stop) {
                          state_ = State::working;
                        }
                      },
                      [&](const WorkDone&) {},
                      [&](const RunEnded& e) {
                        t_s_ = e.end_s;
                        interrupted_ = e.interrupted;
                        if (state_ != State::failed) state_ = State::ended;
                      }},
             event);
}

std::string Progress::json() const {
  ProgressJson json = {{"state", name_of(state_)},
                       {"why", why_},
                       {"t_s", t_s_},
                       {"segment", segment_.segment},
                       {"segments", segments_},
                       {"segment_name", segment_.name},
                       {"segment_start_s", segment_.start_s},
                       {"segment_time_s", segment_time_s_},
                       {"views", views_},
                       {"fruits", fruits_},
                       {"roi_voxels", roi_voxels_},
                       {"graph_nodes", graph_nodes_},
                       {"graph_edges", graph_edges_},
                       {"motions", motions_},
                       {"missed_motions", missed_motions_},
                       {"last_motion", nullptr},
                       {"interrupted", interrupted_},
                       {"lost_events", lost_events_}};
  if (motions_ > 0) {
    json["last_motion"] = {{"kind", motion_.kind},
                           {"ended", motion_.ended},
                           {"why", motion_.why},
                           {"duration_s", motion_.duration_s}};
  }
  return json.dump(-1, ' ', false, ProgressJson::error_handler_t::replace);
}

std::vector<DiagnosticStatus> Progress::diagnostics(const std::string& node) const {
  const bool holds = state_ == State::paused || state_ == State::waiting_for_person;
  const std::uint8_t level = state_ == State::failed ? DiagnosticStatus::ERROR
                             : holds                 ? DiagnosticStatus::WARN
                                                     : DiagnosticStatus::OK;
  DiagnosticStatus mission = status_of(
      node + ": mission", level, std::string(name_of(state_)) + (why_.empty() ? "" : ": " + why_));
  add_value(mission, "mission time s", fmt::format("{:.2f}", t_s_));
  add_value(mission, "segment", fmt::format("{} of {}", segment_.segment + 1, segments_));
  add_value(mission, "segment name", segment_.name);
  add_value(mission, "events lost by this output", lost_events_);

  const bool arrived = motion_.ended == "arrived";
  const bool stopped = motion_.ended == "stopped" || motion_.ended == "preempted";
  DiagnosticStatus arm = status_of(
      node + ": arm",
      arrived ? DiagnosticStatus::OK : (stopped ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN),
      motions_ == 0 ? "not moved yet"
                    : motion_.kind + " motion " + motion_.ended +
                          (motion_.why.empty() ? "" : ": " + motion_.why));
  add_value(arm, "motions", motions_);
  add_value(arm, "motions that did not arrive", missed_motions_);

  DiagnosticStatus camera = status_of(node + ": camera", DiagnosticStatus::OK,
                                      views_ == 0 ? "no frame yet" : "frames taken");
  add_value(camera, "frames", views_);
  add_value(camera, "last frame at mission time s", fmt::format("{:.2f}", last_view_s_));

  DiagnosticStatus map = status_of(node + ": map", DiagnosticStatus::OK, "mapped");
  add_value(map, "fused points", fused_points_);
  add_value(map, "region of interest voxels", roi_voxels_);
  add_value(map, "fruits", fruits_);
  add_value(map, "graph nodes", graph_nodes_);
  return {std::move(mission), std::move(arm), std::move(camera), std::move(map)};
}

}  // namespace canopeer::ros
