#include "canopeer/run/stage.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "canopeer/base/exact_text.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/mission/mission_time.h"
#include "canopeer/mission/row_segments.h"
#include "canopeer/sim/truth_planners.h"

namespace canopeer {
namespace {

/// One thread acts and searches, the others grow the graph.
void put_on_the_wall_clock(MissionFile& file, int threads) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  file.simulation.realtime = true;
  file.mission.background_workers = std::max(1, (threads > 0 ? threads : cores) - 1);
  file.compute_table = "wall-clock";
}

/// The home states of the sides a mission visits must exist before anything moves.
Expected<void> check_sides(const MissionFile& file, const RobotModel& robot) {
  const auto beyond = [](const char* name, const Joint& axis, double value) -> std::string {
    if (value >= axis.lower - kLimitTolerance && value <= axis.upper + kLimitTolerance) return {};
    return std::string(" (") + name + " " + exact_text(value) + " m, limits " +
           exact_text(axis.lower) + " ... " + exact_text(axis.upper) + " m)";
  };
  for (const auto& segment : file.mission.segments) {
    const std::string home = "side_" + std::to_string(segment.side);
    if (segment.side > robot.sides() || !robot.has_home(home)) {
      return fail(file.robot.string() + ": has no boxes or home state for " + home +
                  ", which the mission visits");
    }
    const std::string where = beyond("travel", robot.travel_axis(), segment.trolley.travel_m) +
                              beyond("lift", robot.lift_axis(), segment.trolley.lift_m);
    if (!where.empty()) {
      return fail("stops_travel_m, lifts_m: " + segment.name +
                  " is beyond the limits of the trolley's axes in " + file.robot.string() + where);
    }
  }
  return {};
}

/// Where unknown space blocks and nothing is known to be free, the arm could not leave its home.
Expected<void> check_known_free(const MissionFile& file, const RobotModel& robot) {
  if (!file.mission.collision.unknown_blocks || !robot.setup().known_free.isEmpty()) return {};
  return fail(file.robot.string() +
              ": 'collision.unknown: blocked' needs known_free here, a box in the frame of '" +
              robot.setup().base_link +
              "' in which there is nothing but the robot (the aisle, say): without it the arm "
              "cannot leave its home");
}

/// A site of one's own may be anything.
Expected<void> check_site(const std::string& name, Site* site, bool realtime) {
  const Ports ports = site != nullptr ? site->ports() : Ports{};
  if (ports.clock == nullptr || ports.arm == nullptr || ports.trolley == nullptr ||
      ports.camera == nullptr) {
    return fail("site '" + name + "': a port is missing (clock, arm, trolley or camera)");
  }
  if (ports.clock->simulated() == realtime) {
    return fail("site '" + name + "': its time is " +
                (realtime ? "simulated, run it without --realtime"
                          : "the wall clock's, run it with --realtime"));
  }
  return {};
}

Expected<void> check(const MissionFile& file, const RobotModel& robot,
                     const Registries& registries) {
  if (file.mission.segments.empty()) return fail("the mission has no segments");
  if (auto ok = check_sides(file, robot); !ok) return ok;
  if (auto ok = check_known_free(file, robot); !ok) return ok;
  const auto detector = registries.detectors.make(file.mission.detector);
  if (!detector) return tl::unexpected(detector.error());
  return {};
}

Expected<void> check_planner(const MissionOptions& mission, const PlannerRegistry& planners) {
  const auto planner = planners.make(mission.planner, mission.planners);
  if (!planner) return tl::unexpected(planner.error());
  return {};
}

}  // namespace

Stage::Stage(MissionFile file, RobotModel robot, ArmIk ik, const RunRegistries& registries)
    : file_(std::move(file)),
      robot_(std::move(robot)),
      ik_(std::move(ik)),
      registries_(registries) {}

Expected<std::unique_ptr<Stage>> Stage::make(const StageRequest& request,
                                             const RunRegistries& registries) {
  auto file = load_mission(request.mission, request.overrides, request.table_dirs, registries);
  if (!file) return tl::unexpected(file.error());
  return make(std::move(*file), request, registries);
}

Expected<std::unique_ptr<Stage>> Stage::make(MissionFile file, const StageRequest& request,
                                             const RunRegistries& registries) {
  const SiteManners manners = registries.sites.manners(request.site);
  const bool realtime = request.realtime || manners.realtime;
  if (realtime) put_on_the_wall_clock(file, request.threads);
  if (!request.fuel_caches.empty()) file.world.import.fuel_caches = request.fuel_caches;
  auto robot = load_robot(file.robot, file.T_frame_camera, request.package_path);
  if (!robot) return tl::unexpected(robot.error());
  for (const std::string& notice : robot->description().notices) {
    if (request.callbacks.on_notice) request.callbacks.on_notice(notice);
  }
  if (manners.arm_speed) robot->slow_down(manners.arm_speed(file));
  auto ik = ArmIk::make(*robot);
  if (!ik) return tl::unexpected(ik.error());
  file.mission.planners.playback.fit =
      PlanFit{static_cast<int>(file.mission.segments.size()), robot->limits()};
  if (auto ok = check(file, *robot, registries); !ok) return tl::unexpected(ok.error());
  MissionOptions& mission = file.mission;
  const PlannerManners planner = registries.planners.manners(mission.planner);
  if (!planner.knows_truth) {  // before a large world is built
    if (auto ok = check_planner(mission, registries.planners); !ok) {
      return tl::unexpected(ok.error());
    }
  }
  if (mission.clock == MissionClock::whole) {
    mission.mission_time_s = whole_mission_time_s(*robot, mission);
  }
  if (planner.drives_along_row) {
    mission.segments =
        segments_along_row(mission.segments, mission.segment_time_s, mission.max_views);
  }
  std::unique_ptr<Stage> stage(
      new Stage(std::move(file), std::move(*robot), std::move(*ik), registries));
  auto site = registries.sites.make(request.site, {stage->file_, stage->robot_, request.callbacks});
  if (!site) return tl::unexpected(site.error());
  if (auto ok = check_site(request.site, site->get(), realtime); !ok) {
    return tl::unexpected(ok.error());
  }
  stage->site_ = std::move(*site);
  if (planner.knows_truth) {
    PlannerOptions& told = stage->file_.mission.planners;
    if (const Scene* truth = stage->site_->truth()) tell_truth(*truth, told);
    if (auto ok = check_planner(stage->file_.mission, registries.planners); !ok) {
      return fail_in("site '" + request.site + "'", ok.error());
    }
  }
  return stage;
}

}  // namespace canopeer
