// A planner of your own, and the whole program with it in: run, bench, reports.
//   02_own_planner run missions/smoke.yaml --planner plucky
//   02_own_planner bench missions/smoke.yaml --planners plucky,vmp,random --runs 3 --out out/plucky

#include "canopeer/base/rng.h"
#include "canopeer/planner/view_mover.h"
#include "canopeer/program.h"

using namespace canopeer;

namespace {

/// Looks at any target in reach, fruits before all else; never thinks twice.
class PluckyPlanner : public Planner {
 public:
  explicit PluckyPlanner(int tries) : tries_(tries) {}

  void begin_segment(const PlanningScene& scene) override {
    scene_ = scene;
    mover_ = std::make_unique<ViewMover>(scene, MotionPlannerOptions{});
    rng_ = Rng(scene.seed, "plucky", static_cast<std::uint64_t>(scene.segment.index));
  }

  void map_changed(MapChange change) override { targets_ = std::move(change.targets); }

  Decision decide(const Configuration& q, WorkMeter& work) override {
    const bool fruit = !targets_.roi.empty();
    const auto& voxels = fruit ? targets_.roi : targets_.occupied;
    const TargetKind kind = fruit ? TargetKind::roi : TargetKind::occupied;
    const Box& workspace = scene_.segment.workspace_base;
    for (int i = 0; i < tries_ && !voxels.empty(); ++i) {
      work.add(Work::candidate);  // thinking costs mission time
      const VoxelIndex& voxel = voxels[rng_.index(voxels.size())];
      const Vec3 target_world = voxel_centre(voxel, scene_.map->resolution_m());
      Vec3 camera_base;
      for (int axis = 0; axis < 3; ++axis) {
        camera_base[axis] = rng_.uniform(workspace.min()[axis], workspace.max()[axis]);
      }
      const Vec3 camera_world = scene_.segment.T_world_base * camera_base;
      if ((camera_world - target_world).norm() > 0.8) continue;
      if (ray_blocked(*scene_.map, target_world, camera_world, 0.03)) continue;
      const auto goal = mover_->reach(camera_world, target_world, q, work);
      if (!goal) continue;
      if (auto move = mover_->go(q, *goal, kind, work)) return *move;
    }
    return {};  // wait; what the next question draws is something else
  }

 private:
  int tries_;
  PlanningScene scene_;
  std::unique_ptr<ViewMover> mover_;
  FrontierTargets targets_;
  Rng rng_{0};
};

/// Its options are those of the mission's section `own_planner`: --set own_planner.tries=500.
Expected<std::unique_ptr<Planner>> make_plucky(const PlannerOptions& options) {
  const auto tries = options.own.find("tries");
  if (tries == options.own.end()) return std::make_unique<PluckyPlanner>(200);
  const int number = std::atoi(tries->second.c_str());
  if (number < 1) return fail("own_planner.tries: expected a number of at least 1");
  return std::make_unique<PluckyPlanner>(number);
}

}  // namespace

int main(int argc, char** argv) {
  RunRegistries registries = RunRegistries::built_in();
  if (!registries.planners.add("plucky", "looks at any target in reach", make_plucky)) return 1;
  return run_program(argc, argv, registries);
}
