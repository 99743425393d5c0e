// The four ports of a robot of your own, as a site that missions can name.
//   04_own_robot run missions/smoke.yaml --site own_robot     (a real one: --realtime too)
// Where the comments say DRIVER, talk to yours; here it is a few variables and a renderer.

#include "canopeer/program.h"
#include "canopeer/render/renderer.h"
#include "canopeer/robot/path_timing.h"

using namespace canopeer;

class OwnRobot : public Site, Arm, Camera, Trolley, Clock {
 public:
  OwnRobot(const SiteRequest& at, const Scene& world)
      : robot_(at.robot), judge_(at.robot), camera_(at.file.simulation.camera), row_(world) {
    q_ = robot_.home("side_1");
    trolley_ = at.file.mission.segments.front().trolley;
  }
  Ports ports() override { return {this, this, this, this}; }
  const ExactChecker& judge() const override { return judge_; }

  // Arm: follow the path just as it is, since just this path was checked for collisions.
  Configuration configuration() const override { return q_; }
  Expected<double> start(const JointPath& path) override {
    motion_.emplace(path, robot_);
    return motion_->duration_s();
  }
  Expected<MotionOutcome> finish() override {
    for (double t_s = 0.0; t_s < motion_->duration_s(); t_s += 0.01) {
      q_ = motion_->at(t_s);  // DRIVER: a set point every 10 ms, with motion_->velocity_at(t_s)
    }
    q_ = motion_->at(motion_->duration_s());  // DRIVER: where the joints really are now
    time_s_ += motion_->duration_s();
    MotionOutcome outcome;  // DRIVER: and how it ended, if not there
    outcome.q = q_;
    return outcome;
  }
  TrolleyState state() const override { return trolley_; }
  Expected<void> move_to(const TrolleyState& goal) override {
    time_s_ += std::hypot(goal.travel_m - trolley_.travel_m, goal.lift_m - trolley_.lift_m);
    trolley_ = goal;  // DRIVER: drive, wait, say what failed; here it goes 1 m/s
    return {};
  }
  Expected<RgbdFrame> capture() override {
    RgbdFrame frame;
    frame.time_s = time_s_;
    frame.intrinsics = camera_;
    frame.T_world_camera = robot_.T_world_base(trolley_) * robot_.T_base_camera(q_);
    RenderedView seen = row_.render(camera_, frame.T_world_camera);  // DRIVER: its images
    frame.depth = std::move(seen.depth);
    frame.color = std::move(seen.color);
    return frame;
  }
  // Clock: on a real robot std::chrono, where computing takes its time by itself.
  double now_s() const override { return time_s_; }
  void charge(double compute_s) override { time_s_ += compute_s; }
  void sleep(double seconds) override { time_s_ += seconds; }
  bool simulated() const override { return true; }

 private:
  const RobotModel& robot_;
  ExactChecker judge_;
  CameraIntrinsics camera_;
  Renderer row_;
  Configuration q_;
  TrolleyState trolley_;
  std::optional<PathMotion> motion_;
  double time_s_ = 0.0;
};

int main(int argc, char** argv) {
  RunRegistries registries = RunRegistries::built_in();
  const auto make = [](const SiteRequest& request) -> Expected<std::unique_ptr<Site>> {
    const auto world = build_world(request.file.world, request.file.mission.seed);
    if (!world) return fail(world.error().message);
    return std::make_unique<OwnRobot>(request, world->scene);
  };
  const bool added = registries.sites.add("own_robot", "my arm", make).has_value();
  return added ? run_program(argc, argv, registries) : 1;
}
