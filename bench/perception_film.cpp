#include "perception_film.h"

#include "canopeer/render/renderer.h"
#include "canopeer/render/rgbd_sensor.h"
#include "canopeer/robot/path_timing.h"
#include "canopeer/sim/robot_track.h"
#include "canopeer/viewgraph/view_sampler.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

constexpr std::size_t kFrames = 180;
constexpr double kMaxMotion = 2.0;  // Σ|Δq|, rad: as the edges of a view graph

/// Views one after the other, each a straight free motion from the last.
class ViewTour {
 public:
  explicit ViewTour(const test::FirstStop& stop, const FrontierTargets& targets)
      : stop_(stop),
        sampler_(stop.frame, stop.robot, stop.ik, {}),
        targets_(sampler_.targets_in_reach(targets, stop.mission.map.resolution_m, {})) {}

  Configuration after(const Configuration& q) {
    WorkMeter work;
    while (true) {
      const auto view =
          sampler_.sample(stop_.perception.map(), stop_.checker, targets_, rng_, work);
      if (view && joint_distance(q, view->q) <= kMaxMotion && stop_.checker.edge_free(q, view->q)) {
        return view->q;
      }
      // From home everything is far.
      if (view && q == stop_.frame.home && stop_.checker.edge_free(q, view->q)) return view->q;
    }
  }

 private:
  const test::FirstStop& stop_;
  ViewSampler sampler_;
  TargetSampler targets_;
  Rng rng_{1, "film"};
};

std::vector<FilmedFrame> shoot() {
  test::PlanningFixture world;
  const Renderer renderer(world.scene);
  RgbdSensorOptions options;
  options.motion.exposure_s = 0.005;
  const RgbdSensor camera(renderer, world.scene, options);
  ViewTour tour(world, world.home.change.targets);

  std::vector<FilmedFrame> frames;
  Configuration q = world.frame.home;
  double start_s = 0.0;
  while (frames.size() < kFrames) {
    const JointPath path{{q, tour.after(q)}};
    RobotTrack track(world.robot, q, world.frame.trolley);
    track.move_arm(path, start_s);
    const double end_s = start_s + PathMotion(path, world.robot).duration_s();
    for (; frames.size() < kFrames;) {
      const double t_s = static_cast<double>(frames.size()) / kFilmHz;
      if (t_s >= end_s) break;
      frames.push_back({camera.capture_moving([&](double at_s) { return track.camera_at(at_s); },
                                              t_s, frames.size()),
                        track.twist_at(t_s), track.arm_at(t_s)});
    }
    start_s = end_s;
    q = path.waypoints.back();
  }
  return frames;
}

}  // namespace

const std::vector<FilmedFrame>& film() {
  static const std::vector<FilmedFrame> kFilm = shoot();
  return kFilm;
}

}  // namespace canopeer
