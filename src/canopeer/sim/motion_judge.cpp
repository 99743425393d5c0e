#include "canopeer/sim/motion_judge.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "canopeer/robot/arm_reach.h"
#include "canopeer/sim/near_space.h"

namespace canopeer {
namespace {

// No point of an arm in use here is farther than this from a joint axis, so |Δq| rad move it at
// most this times |Δq|.
constexpr double kReach = 1.3;

/// Cells that the scene is made of where no map says how large its voxels are.
constexpr double kCellM = 0.01;

constexpr double kChunkM = 0.2;

std::vector<TriangleMesh> structure_of(const Scene& scene) {
  std::vector<TriangleMesh> found;
  for (const auto& part : scene.parts) {
    if (part.static_structure()) found.push_back(part.mesh);
  }
  return found;
}

/// What else is in the box, copies of models too, by the cube of `kChunkM` that triangles begin in.
/// FCL gets to see only what is in chunks near the arm.
std::vector<TriangleMesh> plants_in(const Scene& scene, const Box& box) {
  std::unordered_map<BlockKey, TriangleMesh> chunks;
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance*) {
    if (part.static_structure() || !box.intersects(transformed(part.mesh.bounds(), T))) return;
    const Eigen::Isometry3f T_float = T.cast<float>();
    std::vector<Vec3> corners;
    for (const auto& v : part.mesh.vertices) corners.push_back((T_float * v).cast<double>());
    for (const auto& t : part.mesh.triangles) {
      Box around(corners[t[0]], corners[t[0]]);
      around.extend(corners[t[1]]).extend(corners[t[2]]);
      if (!box.intersects(around)) continue;
      const VoxelIndex cube = voxel_at(corners[t[0]], kChunkM);
      TriangleMesh& chunk = chunks[pack_block(cube.x(), cube.y(), cube.z())];
      const auto first = static_cast<std::uint32_t>(chunk.vertices.size());
      for (const auto corner : t) chunk.vertices.push_back(corners[corner].cast<float>());
      chunk.triangles.push_back({first, first + 1, first + 2});
    }
  });
  std::vector<TriangleMesh> found;
  for (auto& [key, chunk] : chunks) found.push_back(std::move(chunk));
  return found;
}

std::vector<Configuration> states_along(const std::vector<Configuration>& waypoints, double step) {
  std::vector<Configuration> states;
  if (!waypoints.empty()) states.push_back(waypoints.front());
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Configuration delta = waypoints[i] - waypoints[i - 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(delta.cwiseAbs().sum() / step)));
    for (int k = 1; k <= steps; ++k) {
      states.push_back(waypoints[i - 1] + static_cast<double>(k) / steps * delta);
    }
  }
  return states;
}

/// All numbers below `count`: the middle, the quarters, the eighths and so on, and zero.
std::vector<std::size_t> far_apart_first(std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t half = std::bit_floor(count); half > 0; half /= 2) {
    for (std::size_t i = half; i < count; i += 2 * half) order.push_back(i);
  }
  order.push_back(0);
  return order;
}

/// Whether parts that no arm joint moves touch each other. All states of a stop have that in
/// common.
bool parts_at_rest_touch(const RobotModel& robot, const ExactChecker& checker,
                         const Configuration& q, const TrolleyState& trolley) {
  const auto pairs = checker.touching_pairs(q, trolley);
  return std::any_of(pairs.begin(), pairs.end(), [&](const std::pair<int, int>& pair) {
    return robot.arm_joints_before(pair.first) == 0 && robot.arm_joints_before(pair.second) == 0 &&
           robot.pair_checked(pair.first, pair.second);
  });
}

}  // namespace

/// Where the trolley stands, and what is near: a long row as a whole would not fit into memory.
struct MotionJudge::Stop {
  Stop(const MotionJudge& judge, const TrolleyState& place, double edge_m, const Configuration& q)
      : trolley(place),
        space(judge.robot_, judge.scene_, place, edge_m),
        rest_touches(parts_at_rest_touch(judge.robot_, judge.checker_, q, place)) {}

  TrolleyState trolley;
  NearSpace space;
  bool rest_touches;

  /// Made when first asked for: at many stops nobody does.
  const MeshObstacles& plants(const RobotModel& robot, const Scene& scene) {
    std::call_once(plants_made_, [&] {
      const Vec3 base = robot.T_world_base(trolley).translation();
      const Vec3 reach = Vec3::Constant(arm_reach_m(robot));
      plants_ = MeshObstacles(plants_in(scene, Box(base - reach, base + reach)));
    });
    return plants_;
  }

 private:
  std::once_flag plants_made_;
  MeshObstacles plants_{{}};
};

MotionJudge::MotionJudge(const RobotModel& robot, const Scene& scene, double step_m, int stops)
    : step_rad_(step_m / kReach),
      robot_(robot),
      scene_(scene),
      checker_(robot, structure_of(scene)),
      most_stops_(static_cast<std::size_t>(std::max(1, stops))) {}

/// With the map in it.
std::shared_ptr<MotionJudge::Stop> MotionJudge::stop_at(const TrolleyState& trolley,
                                                        const Configuration& q,
                                                        const VoxelMap* map) const {
  const auto known = std::find_if(stops_.begin(), stops_.end(), [&](const auto& stop) {
    return stop->trolley.travel_m == trolley.travel_m && stop->trolley.lift_m == trolley.lift_m &&
           (map == nullptr || map->resolution_m() == stop->space.edge_m());
  });
  if (known != stops_.end()) {
    std::rotate(stops_.begin(), known, known + 1);
  } else {
    const double edge_m = map != nullptr ? map->resolution_m() : kCellM;
    if (stops_.size() >= most_stops_) stops_.pop_back();
    stops_.insert(stops_.begin(), std::make_shared<Stop>(*this, trolley, edge_m, q));
  }
  if (map != nullptr) stops_.front()->space.add(*map);
  return stops_.front();
}

Verdict MotionJudge::judge(const std::vector<Configuration>& waypoints, const TrolleyState& trolley,
                           const VoxelMap* map) const {
  const auto states = states_along(waypoints, step_rad_);
  if (states.empty()) return {};
  std::shared_ptr<Stop> stop;
  std::vector<Configuration> doubtful;
  {
    const std::scoped_lock lock(mutex_);
    // This thread, while it waits for others, takes up no task that wants the lock too.
    tbb::this_task_arena::isolate([&] {
      stop = stop_at(trolley, states.front(), map);
      std::copy_if(states.begin(), states.end(), std::back_inserter(doubtful),
                   [&](const Configuration& q) { return !stop->space.surely_free(q); });
    });
  }
  std::vector<Verdict> verdicts(doubtful.size());
  tbb::parallel_for(std::size_t{0}, doubtful.size(), [&](std::size_t i) {
    verdicts[i].collision = checker_.check(doubtful[i], trolley, map).any();
    verdicts[i].plant_contact =
        checker_.touches(doubtful[i], trolley, stop->plants(robot_, scene_));
  });
  Verdict verdict{stop->rest_touches, false};
  for (const auto& v : verdicts) {
    verdict.collision |= v.collision;
    verdict.plant_contact |= v.plant_contact;
  }
  return verdict;
}

bool MotionJudge::touches(const Configuration& q, const TrolleyState& trolley, Stop& stop) const {
  {
    const std::scoped_lock lock(mutex_);
    if (stop.space.surely_free(q)) return false;
  }
  return checker_.touches(q, trolley, stop.plants(robot_, scene_)) ||
         checker_.check(q, trolley, nullptr).any();
}

bool MotionJudge::free(const std::vector<Configuration>& waypoints,
                       const TrolleyState& trolley) const {
  const auto states = states_along(waypoints, step_rad_);
  if (states.empty()) return true;
  std::shared_ptr<Stop> stop;
  {
    const std::scoped_lock lock(mutex_);
    tbb::this_task_arena::isolate([&] { stop = stop_at(trolley, states.front(), nullptr); });
  }
  if (stop->rest_touches) return false;
  const auto order = far_apart_first(states.size());
  return std::none_of(order.begin(), order.end(),
                      [&](std::size_t i) { return touches(states[i], trolley, *stop); });
}

}  // namespace canopeer
