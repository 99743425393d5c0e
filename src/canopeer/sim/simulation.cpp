#include "canopeer/sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "canopeer/base/exact_text.h"
#include "canopeer/base/rng.h"
#include "canopeer/geometry/state_archive.h"
#include "canopeer/render/renderer.h"
#include "canopeer/robot/corner_rounding.h"
#include "canopeer/sim/robot_track.h"
#include "canopeer/sim/simulation_time.h"

namespace canopeer {
namespace {

RgbdSensorOptions sensor_options(const SimulationOptions& options) {
  RgbdSensorOptions sensor = options.sensor;
  sensor.intrinsics = options.camera;
  sensor.seed = options.seed;
  return sensor;
}

}  // namespace

/// The one world all ports act on.
struct Simulation::State {
  /// What moves on in it.
  struct Moving {
    double now_s = 0.0;
    Configuration q;
    TrolleyState trolley;
    Rng arrival_errors{0};
    std::uint64_t frames = 0;  // taken
    template <typename Archive>
    void serialize(Archive& archive) {
      archive(now_s, q, trolley.travel_m, trolley.lift_m, arrival_errors, frames);
    }
  };

  State(const RobotModel& model, const Scene& scene, const Configuration& start,
        const TrolleyState& place, const SimulationOptions& o)
      : robot(model),
        options(o),
        renderer(scene),
        sensor(renderer, scene, sensor_options(o)),
        judge(model, scene),
        time(o.realtime),
        q(start),
        trolley(place),
        track_(model, start, place),
        arrival_errors(o.seed, "arrival error") {}

  const RobotModel& robot;
  SimulationOptions options;
  Renderer renderer;
  RgbdSensor sensor;
  MotionJudge judge;
  const VoxelMap* map = nullptr;
  SimulationTime time;
  Configuration q;
  TrolleyState trolley;
  RobotTrack track_;
  mutable std::mutex track_mutex;  // frames are fetched in another thread
  Rng arrival_errors;
  std::uint64_t frames = 0;  // taken

  RobotTrack track() const {
    const std::scoped_lock lock(track_mutex);
    return track_;
  }
  template <typename F>
  auto change_track(F&& change) {
    const std::scoped_lock lock(track_mutex);
    return change(track_);
  }
  void stand() {
    change_track([&](RobotTrack& t) { t.stand(q, trolley); });
  }
};

class Simulation::SimClock : public Clock {
 public:
  explicit SimClock(State& state) : state_(state) {}
  double now_s() const override { return state_.time.now_s(); }
  void charge(double compute_s) override { state_.time.charge(compute_s); }
  void sleep(double seconds) override { state_.time.pass_until(state_.time.now_s() + seconds); }
  bool simulated() const override { return !state_.options.realtime; }

 private:
  State& state_;
};

class Simulation::SimArm : public Arm {
 public:
  explicit SimArm(State& state) : state_(state) {}

  Configuration configuration() const override { return state_.q; }

  Expected<double> start(const JointPath& path) override {
    const std::vector<Configuration>& waypoints = path.waypoints;
    const EndlessJoints& endless = state_.robot.endless();
    if (waypoints.empty() || endless.distance(waypoints.front(), state_.q) > 1e-6) {
      return fail("a motion must begin where the arm is");
    }
    for (const Configuration& q : waypoints) {
      if (!state_.robot.within_limits(q)) return fail("a waypoint is beyond the joint limits");
    }
    const double now_s = state_.time.now_s();
    const double duration_s = motion_time(path, state_.robot);
    state_.change_track([&](RobotTrack& t) { t.move_arm(path, now_s); });
    // Judged now, on the map as it is when the motion starts.
    const auto pause = state_.time.pause();
    const Verdict verdict = state_.judge.judge(points_along(path), state_.trolley, state_.map);
    outcome_.q = with_arrival_error(waypoints.back());
    outcome_.collision = verdict.collision;
    outcome_.plant_contact = verdict.plant_contact;
    end_s_ = state_.time.now_s() + duration_s;
    return duration_s;
  }

  Expected<MotionOutcome> finish() override {
    state_.time.pass_until(end_s_);
    state_.q = outcome_.q;
    state_.stand();
    return outcome_;
  }

 private:
  Configuration with_arrival_error(Configuration q) {
    if (state_.options.arrival_error_rad <= 0.0) return q;
    const JointLimits& limits = state_.robot.limits();
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      q[i] = std::clamp(q[i] + state_.arrival_errors.normal(0.0, state_.options.arrival_error_rad),
                        limits.lower[i], limits.upper[i]);
    }
    return q;
  }

  State& state_;
  MotionOutcome outcome_;
  double end_s_ = 0.0;
};

class Simulation::SimTrolley : public Trolley {
 public:
  explicit SimTrolley(State& state) : state_(state) {}
  TrolleyState state() const override { return state_.trolley; }

  Expected<void> move_to(const TrolleyState& goal) override {
    if (auto started = set_out({goal}); !started) return tl::unexpected(started.error());
    return arrive();
  }

  Expected<double> set_out(const Drive& drive) override {
    const TrolleyState& goal = drive.goal;
    const Joint& travel = state_.robot.travel_axis();
    const Joint& lift = state_.robot.lift_axis();
    const auto outside = [](const Joint& axis, double value) {
      return value < axis.lower - kLimitTolerance || value > axis.upper + kLimitTolerance;
    };
    if (outside(travel, goal.travel_m) || outside(lift, goal.lift_m)) {
      return fail("the goal is beyond the axes' limits (travel " + exact_text(goal.travel_m) +
                  " m, lift " + exact_text(goal.lift_m) + " m)");
    }
    goal_ = goal;
    const double duration_s = state_.change_track(
        [&](RobotTrack& t) { return t.drive(goal, drive.max_travel_m_s, state_.time.now_s()); });
    end_s_ = state_.time.now_s() + duration_s;
    return duration_s;
  }

  Expected<void> arrive() override {
    state_.time.pass_until(end_s_);
    state_.trolley = goal_;
    state_.stand();
    return {};
  }

 private:
  State& state_;
  TrolleyState goal_;
  double end_s_ = 0.0;
};

class Simulation::SimCamera : public Camera {
 public:
  explicit SimCamera(State& state) : state_(state) {}

  /// It arrives after the camera's latency.
  Expected<RgbdFrame> capture() override {
    RgbdFrame frame = exposed_now();
    state_.time.pass_until(frame.time_s + state_.options.sensor.motion.latency_s);
    return frame;
  }

  /// Frames are exposed at whole multiples of the period.
  Expected<void> stream(double hz) override {
    hz_ = hz;
    next_ = hz > 0.0 ? static_cast<std::int64_t>(std::floor(state_.time.now_s() * hz)) + 1 : 0;
    return {};
  }

  Expected<std::vector<StreamedFrame>> arrived() override {
    std::vector<StreamedFrame> frames;
    if (hz_ <= 0.0) return frames;
    const double now_s = state_.time.now_s();
    const double latency_s = state_.options.sensor.motion.latency_s;
    for (; static_cast<double>(next_) / hz_ + latency_s <= now_s; ++next_) {
      frames.push_back(frame_at(static_cast<double>(next_) / hz_));
      frames.back().arrived_s = static_cast<double>(next_) / hz_ + latency_s;
    }
    return frames;
  }

 private:
  RgbdFrame exposed_now() {
    const auto pause = state_.time.pause();
    RgbdFrame frame = state_.sensor.capture(
        state_.robot.T_world_base(state_.trolley) * state_.robot.T_base_camera(state_.q),
        state_.frames++);
    frame.time_s = state_.time.now_s();
    return frame;
  }

  /// Its images are rendered when somebody wants them.
  StreamedFrame frame_at(double exposed_s) {
    const std::uint64_t number = state_.frames++;
    const RobotTrack track = state_.track();  // another motion may have begun by then
    StreamedFrame frame;
    frame.time_s = state_.sensor.stamp_of(exposed_s, number);
    frame.intrinsics = state_.options.camera;
    frame.T_world_camera = track.camera_at(frame.time_s);
    frame.twist = track.twist_at(frame.time_s);
    frame.q = track.arm_at(frame.time_s);
    frame.trolley = track.trolley_at(frame.time_s);
    frame.images = [this, track, exposed_s, number]() -> Expected<RgbdFrame> {
      return state_.sensor.capture_moving([&track](double t_s) { return track.camera_at(t_s); },
                                          exposed_s, number);
    };
    return frame;
  }

  State& state_;
  double hz_ = 0.0;
  std::int64_t next_ = 0;  // multiple of the period
};

Simulation::Simulation(const RobotModel& robot, const Scene& scene, const Configuration& q,
                       const TrolleyState& trolley, const SimulationOptions& options)
    : state_(new State(robot, scene, q, trolley, options)),
      clock_(std::make_unique<SimClock>(*state_)),
      arm_(std::make_unique<SimArm>(*state_)),
      trolley_(std::make_unique<SimTrolley>(*state_)),
      camera_(std::make_unique<SimCamera>(*state_)) {}

Simulation::~Simulation() = default;

Ports Simulation::ports() { return {clock_.get(), arm_.get(), trolley_.get(), camera_.get()}; }

void Simulation::watch_map(const VoxelMap* map) { state_->map = map; }

const MotionJudge& Simulation::judge() const { return state_->judge; }

std::string Simulation::state() const {
  const State& s = *state_;
  return state_bytes(State::Moving{s.time.now_s(), s.q, s.trolley, s.arrival_errors, s.frames});
}

Expected<void> Simulation::restore(std::string_view state) {
  State::Moving then;
  if (auto ok = read_state_bytes(state, then); !ok) return ok;
  State& s = *state_;
  if (then.q.size() != s.q.size()) return fail("the state is of another robot");
  s.time.set_simulated(then.now_s);
  s.q = then.q;
  s.trolley = then.trolley;
  s.arrival_errors = then.arrival_errors;
  s.frames = then.frames;
  s.stand();
  return {};
}

}  // namespace canopeer
