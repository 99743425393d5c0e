#include "canopeer/mission/mission.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "canopeer/mission/segment_runner.h"
#include "canopeer/mission/traveller.h"

namespace canopeer {
namespace {

/// No point of the arm is ever farther than this from the origin of its base link, m: the lengths
/// along the chain added up.
double reach_m(const RobotModel& robot) {
  double farthest = 0.0;
  std::vector<Pose> T_world_link;
  robot.link_poses(Configuration::Zero(robot.dof()), {}, T_world_link);
  const int first = robot.moving_links().front();
  double begin = (T_world_link[static_cast<std::size_t>(first)].translation() -
                  robot.T_world_base({}).translation())
                     .norm();
  if (robot.arm_joint_type(0) == JointType::kPrismatic)
    begin += std::max(std::abs(robot.limits().lower[0]), std::abs(robot.limits().upper[0]));
  for (const int link : robot.moving_links()) {
    double way = begin;
    for (const RobotModel::Hop& hop : robot.arm_hops(link)) way += hop.offset.norm() + hop.slide;
    for (const CollisionShape& shape : robot.links()[link].collision) {
      farthest = std::max(
          farthest, way + shape.T_link_shape.translation().norm() + shape.half_extents().norm());
    }
  }
  return farthest;
}

/// Where the distance field ends nothing is known to be in the way, so it reaches as far as the
/// arm.
MissionOptions with_reach_of(const RobotModel& robot, MissionOptions options) {
  options.field_reach_m = std::max(options.field_reach_m, reach_m(robot));
  return options;
}

}  // namespace

struct Mission::State {
  const RobotModel& robot;
  const ArmIk& ik;
  const ExactChecker& judge;
  Ports ports;
  MissionOptions options;
  const std::atomic<bool>& stop;
  Perception perception;
  Traveller traveller;
  RunRecord record;
  StageTimer timer;
  WorkMeter foreground;
  WorkMeter background;
  ProgressSink progress;

  [[nodiscard]] Configuration home_of(std::size_t segment) const {
    return robot.home("side_" + std::to_string(options.segments[segment].side));
  }
  [[nodiscard]] Expected<void> run_segments(Planner& planner, RecordWriter& writer);
  [[nodiscard]] Expected<void> drive(std::size_t segment, RecordWriter& writer);
  [[nodiscard]] std::vector<WorkItem> work_items() const;
};

Mission::Mission(const RobotModel& robot, const ArmIk& ik, const ExactChecker& judge,
                 const Ports& ports, const MissionOptions& options, const std::atomic<bool>& stop)
    : state_(new State{robot,
                       ik,
                       judge,
                       ports,
                       options,
                       stop,
                       Perception(with_reach_of(robot, options)),
                       Traveller(robot, options.motion, options.seed),
                       {},
                       {},
                       {},
                       {},
                       {}}) {}

Mission::~Mission() = default;

void Mission::on_progress(ProgressSink sink) { state_->progress = std::move(sink); }
const RunRecord& Mission::record() const { return state_->record; }
const VoxelMap& Mission::map() const { return state_->perception.map(); }
const FruitMap& Mission::fruits() const { return state_->perception.fruits(); }
const StageTimer& Mission::timer() const { return state_->timer; }

Expected<void> Mission::run(RecordWriter& writer) {
  auto planner = make_planner(state_->options.planner, state_->options.planners);
  if (!planner) return fail(planner.error().message);
  const auto outcome = state_->run_segments(**planner, writer);
  state_->perception.finish(state_->timer);
  RunRecord& record = state_->record;
  record.work = state_->work_items();
  record.end_s = state_->ports.clock->now_s();
  record.interrupted = state_->stop || !outcome;
  if (auto ok = writer.set_work(record.work); !ok) return ok;
  if (auto ok = writer.finish(record.end_s, record.interrupted); !ok) return ok;
  return outcome;
}

Expected<void> Mission::State::run_segments(Planner& planner, RecordWriter& writer) {
  Background aside(planner, *ports.clock, options.background_workers, background);
  MissionContext context{robot, ik,        judge,  ports,  options, stop,       perception, planner,
                         aside, traveller, writer, record, timer,   foreground, progress};
  traveller.forget_way(ports.arm->configuration());
  for (std::size_t i = 0; i < options.segments.size() && !stop; ++i) {
    if (auto ok = drive(i, writer); !ok) return ok;
    SegmentRunner segment(context, static_cast<int>(i));
    // The arm goes to the next segment's home at once: it is home before the trolley moves.
    const std::size_t next = std::min(i + 1, options.segments.size() - 1);
    if (auto ok = segment.run(home_of(next)); !ok) return ok;
  }
  return {};
}

/// Brings the trolley to the segment's stop.
Expected<void> Mission::State::drive(std::size_t segment, RecordWriter& writer) {
  const TrolleyState& goal = options.segments[segment].trolley;
  const TrolleyState from = ports.trolley->state();
  if (goal.travel_m == from.travel_m && goal.lift_m == from.lift_m) return {};
  MotionEvent event;
  event.kind = "trolley";
  event.segment = static_cast<int>(segment);
  event.start_s = ports.clock->now_s();
  if (auto ok = ports.trolley->move_to(goal); !ok) return fail_in("trolley", ok.error());
  event.duration_s = ports.clock->now_s() - event.start_s;
  if (auto ok = writer.add(event); !ok) return ok;
  record.motions.push_back(event);
  return {};
}

std::vector<WorkItem> Mission::State::work_items() const {
  std::vector<WorkItem> items;
  for (const auto& [meter, where] :
       {std::pair{&foreground, ""}, std::pair{&background, " (background)"}}) {
    for (std::size_t i = 0; i < kWorkKinds; ++i) {
      const auto kind = static_cast<Work>(i);
      const std::int64_t units = meter->units(kind);
      if (units == 0) continue;
      items.push_back({std::string(work_name(kind)) + where, units,
                       static_cast<double>(units) * options.costs[kind]});
    }
  }
  return items;
}

}  // namespace canopeer
