#include "canopeer/planner/drive_by/drive_by_planner.h"

#include <algorithm>
#include <cmath>

#include "canopeer/geometry/state_archive.h"
#include "canopeer/planner/drive_by/drive_speed.h"
#include "canopeer/robot/arm_extent.h"

namespace canopeer {
namespace {

constexpr double kStands = 0.02;       // m: a trolley as near to a place is there
constexpr double kAtPose = 0.05;       // rad, Σ|Δq|: so is an arm
constexpr double kStepM = 0.1;         // between places where the camera could be parked
constexpr double kLookM = 0.5;         // any: the camera looks in a direction
constexpr double kAisleMargin = 0.03;  // m: an arm that stands a little beside is within it still
constexpr int kMaxMotions = 2;         // tries to get to a pose
constexpr double kLookEveryM = 0.3;    // along the row, where it has to stop to look

/// The middle, then on either side of it, ever farther away.
std::vector<double> from_the_middle(double low, double high, double step) {
  const double middle = 0.5 * (low + high);
  std::vector<double> places = {middle};
  for (double away = step; away <= 0.5 * (high - low); away += step) {
    places.push_back(middle - away);
    places.push_back(middle + away);
  }
  return places;
}

}  // namespace

DriveByPlanner::DriveByPlanner(const DriveByOptions& options) : options_(options) {}

void DriveByPlanner::begin_segment(const PlanningScene& scene) {
  scene_ = scene;
  mover_ = std::make_unique<ViewMover>(scene, options_.motion);
  region_base_ = sampling_region_base(scene.segment);
  plan_passes();
  next_ = 0;
  motions_ = drives_ = 0;
  lifted_ = false;
  goal_m_.reset();
  parked_.reset();
  ever_parked_ = false;
}

void DriveByPlanner::plan_passes() {
  row_ = row_ahead(scene_.segment.workspace_base, region_base_, options_.row_distance_m);
  passes_.clear();
  std::vector<double> lifts;
  for (const TrolleyState& stop : scene_.segment.row) {
    if (std::find(lifts.begin(), lifts.end(), stop.lift_m) == lifts.end())
      lifts.push_back(stop.lift_m);
  }
  if (lifts.empty()) lifts.push_back(scene_.segment.trolley.lift_m);
  std::vector<Vec3> directions = scan_directions(row_, options_.tilt_rad);
  if (options_.tilt_rad == 0.0) directions.resize(1);
  for (const Vec3& direction : directions) {
    for (const double lift : lifts) {
      for (const double height : heights()) passes_.push_back({lift, height, direction});
    }
    std::reverse(lifts.begin(), lifts.end());
  }
}

std::vector<double> DriveByPlanner::heights() const {
  const Box& workspace = scene_.segment.workspace_base;
  double low = std::max(workspace.min().z(), region_base_.min().z());
  double high = std::min(workspace.max().z(), region_base_.max().z());
  if (low > high) {
    low = workspace.min().z();
    high = workspace.max().z();
  }
  std::vector<double> heights;
  for (int i = 0; i < options_.poses; ++i) {
    heights.push_back(low + (high - low) * (i + 0.5) / options_.poses);
  }
  return heights;
}

void DriveByPlanner::moved(const PlanningScene& scene) {
  const TrolleyState before = scene_.segment.trolley;
  scene_ = scene;
  // As near to the goal as it gets: it drove all the way, or no farther than before.
  const double left = goal_m_ ? std::abs(*goal_m_ - scene.segment.trolley.travel_m) : 0.0;
  const double driven = std::abs(scene.segment.trolley.travel_m - before.travel_m);
  if (scene.looks_on_the_way || driven < kStands || left < kStands) goal_m_.reset();
  mover_->moved(scene);
}

Decision DriveByPlanner::decide(const Configuration& q, WorkMeter& work) {
  Decision stuck;
  stuck.action = Decision::Action::stuck;
  while (next_ < passes_.size()) {
    const Pass& pass = passes_[next_];
    const TrolleyState& now = scene_.segment.trolley;
    if (std::abs(now.lift_m - pass.lift_m) > kStands && !lifted_) {
      if (!may_drive(q)) return stuck;
      lifted_ = true;  // once: it stops where it stops
      return drive({now.travel_m, pass.lift_m}, q);
    }
    const bool parked = parked_ && scene_.robot->endless().distance(q, *parked_) < kAtPose;
    if (!parked && motions_ < kMaxMotions) {
      if (auto to_pose = park(pass, q, work)) return *to_pose;
      next_pass();
      continue;
    }
    // Beside its pose it looks at the row all the same.
    if (!may_drive(q)) return stuck;
    if (const auto end = next_end(pass.lift_m)) return drive(*end, q);
    next_pass();
  }
  if (ever_parked_) {
    Decision done;
    done.action = Decision::Action::done;
    return done;
  }
  next_ = 0;  // from home there may be a way
  return stuck;
}

void DriveByPlanner::next_pass() {
  ++next_;
  motions_ = drives_ = 0;
  lifted_ = false;
  goal_m_.reset();
  parked_.reset();
}

/// To the pose of a pass, on the first way there is.
std::optional<Decision> DriveByPlanner::park(const Pass& pass, const Configuration& q,
                                             WorkMeter& work) {
  const Box& workspace = scene_.segment.workspace_base;
  const double farthest =
      row_.forward[row_.depth] > 0.0 ? workspace.min()[row_.depth] : workspace.max()[row_.depth];
  for (double back = 0.0; back <= std::abs(row_.plane_m - farthest); back += kStepM) {
    for (const double along :
         from_the_middle(workspace.min()[row_.along], workspace.max()[row_.along], kStepM)) {
      Vec3 camera_base;
      camera_base[row_.depth] = row_.plane_m - back * row_.forward[row_.depth];
      camera_base[row_.along] = along;
      camera_base.z() = pass.height_m;
      const auto goal = parking(camera_base, pass, q, work);
      if (!goal) continue;
      auto decision = mover_->go(q, *goal, TargetKind::none, work);
      if (!decision) continue;
      ++motions_;
      parked_ = decision->motion.waypoints.back();
      ever_parked_ = true;
      return decision;
    }
  }
  return std::nullopt;
}

/// The free configuration nearest to `q` with which the trolley may drive.
std::optional<Configuration> DriveByPlanner::parking(const Vec3& camera_base, const Pass& pass,
                                                     const Configuration& q,
                                                     WorkMeter& work) const {
  work.add(Work::candidate);
  work.add(Work::view_ik);
  std::vector<Configuration> solutions;
  scene_.ik->solve_view(camera_base, camera_base + kLookM * pass.direction_base, q, solutions);
  const bool aisle_known = !scene_.robot->setup().known_free.isEmpty();
  for (const Configuration& solution : solutions) {
    if (aisle_known && !keeps_to_aisle(*scene_.robot, solution, kAisleMargin)) continue;
    work.add(Work::state_check);
    if (scene_.checker->state_free(solution)) return solution;
  }
  return std::nullopt;
}

bool DriveByPlanner::may_drive(const Configuration& q) const {
  const bool aisle_known = !scene_.robot->setup().known_free.isEmpty();
  return !aisle_known || keeps_to_aisle(*scene_.robot, q) ||
         scene_.robot->endless().distance(q, scene_.segment.home) < kAtPose;
}

/// Where to drive next in a pass: to the nearer end of the row, unless it is there, then to the
/// other. Nothing: the pass is over.
std::optional<TrolleyState> DriveByPlanner::next_end(double lift_m) {
  const double now = scene_.segment.trolley.travel_m;
  if (goal_m_ && std::abs(*goal_m_ - now) > kStands) return TrolleyState{*goal_m_, lift_m};
  double first = now;
  double last = now;
  bool any = false;
  for (const TrolleyState& stop : scene_.segment.row) {
    first = any ? std::min(first, stop.travel_m) : stop.travel_m;
    last = any ? std::max(last, stop.travel_m) : stop.travel_m;
    any = true;
  }
  if (!any) return std::nullopt;
  const Joint& rails = scene_.robot->travel_axis();
  first = std::max(first - options_.overrun_m, std::min(first, rails.lower));
  last = std::min(last + options_.overrun_m, std::max(last, rails.upper));
  while (drives_ < 2) {
    const bool first_is_near = std::abs(now - first) < std::abs(now - last);
    const double goal = (drives_++ == 0) == first_is_near ? first : last;
    if (std::abs(goal - now) <= kStands) continue;
    goal_m_ = goal;
    return TrolleyState{goal, lift_m};
  }
  return std::nullopt;
}

Decision DriveByPlanner::drive(const TrolleyState& goal, const Configuration& q) const {
  Decision decision;
  decision.action = Decision::Action::drive;
  decision.drive.goal = goal;
  if (!scene_.looks_on_the_way) {
    const double now = scene_.segment.trolley.travel_m;
    decision.drive.goal.travel_m = std::clamp(goal.travel_m, now - kLookEveryM, now + kLookEveryM);
  }
  if (!scene_.sharp) return decision;
  const double speed = drive_speed(*scene_.robot, q, *scene_.sharp);
  if (std::isfinite(speed)) decision.drive.max_travel_m_s = speed;
  return decision;
}

Expected<std::string> DriveByPlanner::state() const {
  if (!mover_) return fail("no segment has begun");
  return state_bytes(*mover_, region_base_, next_, motions_, drives_, lifted_, goal_m_, parked_,
                     ever_parked_);
}

Expected<void> DriveByPlanner::restore(const PlanningScene& scene, std::string_view state) {
  begin_segment(scene);
  auto read = read_state_bytes(state, *mover_, region_base_, next_, motions_, drives_, lifted_,
                               goal_m_, parked_, ever_parked_);
  if (read) plan_passes();
  return read;
}

}  // namespace canopeer
