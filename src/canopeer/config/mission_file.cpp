#include "canopeer/config/mission_file.h"

#include <map>

#include "canopeer/config/camera_section.h"
#include "canopeer/config/cost_table_file.h"
#include "canopeer/config/detector_section.h"
#include "canopeer/config/frames_section.h"
#include "canopeer/config/fruit_section.h"
#include "canopeer/config/gomvp_section.h"
#include "canopeer/config/nbs_section.h"
#include "canopeer/config/protocols.h"
#include "canopeer/config/ros2_file.h"
#include "canopeer/config/world_section.h"
#include "canopeer/config/yaml_reader.h"
#include "canopeer/geometry/angles.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// Order per stop: side 1, side 2, the next lift height, side 1, side 2, the next stop.
void read_segments(YamlMap& file, MissionOptions& mission) {
  const auto travels = file.required_numbers("stops_travel_m", 0, {-1000, 1000});
  const auto lifts = file.numbers("lifts_m", {0.0}, 0, {-100, 100});
  const auto sides = file.numbers("sides", {1, 2}, 0, {1, 2});
  for (std::size_t stop = 0; stop < travels.size(); ++stop) {
    for (std::size_t lift = 0; lift < lifts.size(); ++lift) {
      for (const double side : sides) {
        SegmentPlan plan;
        plan.trolley = {travels[stop], lifts[lift]};
        plan.side = static_cast<int>(side);
        plan.name = "stop " + std::to_string(stop + 1) +
                    (lifts.size() > 1 ? ", level " + std::to_string(lift + 1) : "") + ", side " +
                    std::to_string(plan.side);
        mission.segments.push_back(plan);
      }
    }
  }
  if (mission.segments.empty())
    file.complain("stops_travel_m", "expected at least one stop and one side");
  const int first =
      file.integer("max_segments", static_cast<int>(mission.segments.size()), 1, 100000);
  if (static_cast<std::size_t>(first) < mission.segments.size()) {
    mission.segments.resize(static_cast<std::size_t>(first));
  }
}

void read_map(YamlMap map, MissionOptions& mission) {
  VoxelMapOptions& o = mission.map;
  o.resolution_m = map.number("resolution_m", o.resolution_m, {0.001, 0.2});
  o.hit_probability = map.number("hit_probability", o.hit_probability, {0.501, 0.999});
  o.miss_probability = map.number("miss_probability", o.miss_probability, {0.001, 0.499});
  o.clamp_min = map.number("clamp_min", o.clamp_min, {0.0005, 0.49});
  o.clamp_max = map.number("clamp_max", o.clamp_max, {0.51, 0.9995});
  o.occupied_threshold = map.number("occupied_threshold", o.occupied_threshold, {0.01, 0.99});
  if (auto ok = o.validate(); !ok) map.complain("resolution_m", ok.error().message);
  mission.fusion.max_range_m = map.number("max_range_m", mission.fusion.max_range_m, {0.05, 100.0});
  mission.fusion.clear_no_return = map.boolean("clear_no_return", mission.fusion.clear_no_return);
  mission.mask_robot = map.boolean("mask_robot", mission.mask_robot);
}

void read_view_sampling(YamlMap views, GraphBuilderOptions& o) {
  o.sampler.min_target_distance_m =
      views.number("min_target_distance_m", o.sampler.min_target_distance_m, {0.0, 10.0});
  o.sampler.max_target_distance_m =
      views.number("max_target_distance_m", o.sampler.max_target_distance_m, {0.01, 10.0});
  if (o.sampler.min_target_distance_m >= o.sampler.max_target_distance_m) {
    views.complain("max_target_distance_m", "expected more than min_target_distance_m");
  }
  o.shares.roi = views.number("roi_share", o.shares.roi, {0.0, 1.0});
  o.shares.occupied = views.number("occupied_share", o.shares.occupied, {0.0, 1.0});
  o.shares.border = views.number("border_share", o.shares.border, {0.0, 1.0});
  const double sum = o.shares.roi + o.shares.occupied + o.shares.border;
  if (sum < 0.999 || sum > 1.001) views.complain("roi_share", "the three shares must sum to 1");
}

void read_graph(YamlMap graph, GraphBuilderOptions& o) {
  o.neighbors = graph.integer("neighbors", o.neighbors, 1, 100);
  o.max_edge_distance_rad =
      graph.number("max_edge_distance_rad", o.max_edge_distance_rad, {0.01, 100.0});
  o.max_start_distance_rad =
      graph.number("max_start_distance_rad", o.max_start_distance_rad, {0.01, 100.0});
  o.max_nodes = graph.integer("max_nodes", o.max_nodes, 10, 1000000);
  o.similarity.position_m = graph.number("similar_position_m", o.similarity.position_m, {0.0, 1.0});
  o.similarity.angle_rad =
      graph.number("similar_angle_deg", o.similarity.angle_rad / kDegree, {0.0, 180.0}) * kDegree;
}

void read_search(YamlMap search, VmpOptions& o) {
  const std::string method = search.choice("method", "best_first", {"best_first", "random_walk"});
  o.search =
      method == "best_first" ? VmpOptions::Search::best_first : VmpOptions::Search::random_walk;
  PathSearchOptions& p = o.path_search;
  p.max_expansions = search.integer("max_expansions", p.max_expansions, 1, 10000000);
  p.max_views = search.integer("max_views", p.max_views, 1, 1000);
  p.observe_s = search.number("observe_s", p.observe_s, {0.0, 100.0});
  p.reparent = search.boolean("reparent", p.reparent);
  p.fan.fov_x_rad =
      search.number("fan_fov_x_deg", p.fan.fov_x_rad / kDegree, {1.0, 170.0}) * kDegree;
  p.fan.fov_y_rad =
      search.number("fan_fov_y_deg", p.fan.fov_y_rad / kDegree, {1.0, 170.0}) * kDegree;
  p.fan.columns = search.integer("fan_columns", p.fan.columns, 1, 1000);
  p.fan.rows = search.integer("fan_rows", p.fan.rows, 1, 1000);
  p.fan.max_unknown_m = search.number("max_unknown_m", p.fan.max_unknown_m, {0.01, 10.0});
  p.fan.depth_m = search.number("fan_depth_m", p.fan.depth_m, {0.05, 10.0});
  o.random_walk_views = search.integer("random_walk_views", o.random_walk_views, 1, 1000);
}

void read_execution(YamlMap execution, VmpOptions& o) {
  o.look_ahead_rad = execution.number("look_ahead_rad", o.look_ahead_rad, {0.0, 1000.0});
  o.replan_after_s = execution.number("replan_after_s", o.replan_after_s, {0.0, 1000.0});
  o.min_nodes = execution.integer("min_nodes", o.min_nodes, 1, 100000);
}

void read_rvp(YamlMap rvp, RvpOptions& o) {
  o.views_per_kind = rvp.integer("views_per_kind", o.views_per_kind, 1, 100000);
  o.min_distance_m = rvp.number("min_distance_m", o.min_distance_m, {0.05, 10.0});
  o.max_distance_m = rvp.number("max_distance_m", o.max_distance_m, {0.05, 10.0});
  if (o.min_distance_m >= o.max_distance_m) {
    rvp.complain("max_distance_m", "expected more than min_distance_m");
  }
  o.distance_weight = rvp.number("distance_weight", o.distance_weight, {0.0, 100.0});
  o.roi_threshold = rvp.number("roi_threshold", o.roi_threshold, {-100.0, 100.0});
  o.max_plans = rvp.integer("max_plans", o.max_plans, 1, 1000);
  o.motion.max_iterations = rvp.integer("max_iterations", o.motion.max_iterations, 1, 10000000);
}

void read_scan(YamlMap& section, SerpentineOptions& o) {
  o.spacing_m = section.number("spacing_m", o.spacing_m, {0.02, 10.0});
  o.row_distance_m = section.number("row_distance_m", o.row_distance_m, {0.0, 10.0});
  o.tilt_rad = section.number("tilt_deg", o.tilt_rad / kDegree, {0.0, 85.0}) * kDegree;
}

void read_coverage(YamlMap coverage, CoverageOptions& o) { read_scan(coverage, o.scan); }

void read_sweep(YamlMap sweep, SweepOptions& o) {
  read_scan(sweep, o.scan);
  o.stretch_m = sweep.number("stretch_m", o.stretch_m, {0.01, 1000.0});
}

void read_drive_by(YamlMap drive_by, DriveByOptions& o) {
  o.poses = drive_by.integer("poses", o.poses, 1, 3);
  o.row_distance_m = drive_by.number("row_distance_m", o.row_distance_m, {0.0, 10.0});
  o.tilt_rad = drive_by.number("tilt_deg", o.tilt_rad / kDegree, {0.0, 85.0}) * kDegree;
  o.overrun_m = drive_by.number("overrun_m", o.overrun_m, {0.0, 100.0});
}

void read_playback(YamlMap playback, PlaybackOptions& o) {
  const std::string plan = playback.text("plan", {});
  if (!plan.empty()) o.plan = playback.directory() / plan;
}

void read_collision(YamlMap collision, CollisionOptions& o) {
  o.map_padding_m = collision.number("map_padding_m", o.map_padding_m, {0.0, 0.5});
  o.self_padding_m = collision.number("self_padding_m", o.self_padding_m, {0.0, 0.5});
  o.unknown_blocks = collision.choice("unknown", "free", {"free", "blocked"}) == "blocked";
}

/// The options of somebody's own planner or detector: any keys.
std::map<std::string, std::string> read_own(YamlMap section) {
  std::map<std::string, std::string> own;
  for (const std::string& key : section.keys()) own[key] = section.text(key, {});
  return own;
}

/// Those of `ros2` are of the file that the mission names for it, if it names one.
Expected<std::optional<YamlMap>> set_overrides(YamlMap& mission, const Overrides& overrides) {
  constexpr std::string_view kRos2 = "ros2.";
  for (const auto& [key, value] : overrides) {
    if (key.starts_with(kRos2)) continue;
    if (auto ok = mission.set(key, value); !ok) return tl::unexpected(ok.error());
  }
  auto ros2 = open_ros2_file(mission);
  if (!ros2) return ros2;
  for (const auto& [key, value] : overrides) {
    if (!key.starts_with(kRos2)) continue;
    auto ok = *ros2 ? (*ros2)->set(key.substr(kRos2.size()), value) : mission.set(key, value);
    if (!ok) return tl::unexpected(ok.error());
  }
  return ros2;
}

/// Two flat objects as one.
std::string joined_json(const std::string& a, const std::string& b) {
  if (b == "{}") return a;
  return a.substr(0, a.size() - 1) + (a == "{}" ? "" : ", ") + b.substr(1);
}

Expected<CostTable> find_cost_table(const std::string& name, const fs::path& mission_dir,
                                    const std::vector<fs::path>& dirs) {
  if (name == "free") return CostTable{};
  if (name.ends_with(".yaml")) {
    const fs::path given(name);
    const fs::path beside = mission_dir / given;
    return load_cost_table(fs::exists(beside) ? beside : given);
  }
  for (const auto& dir : dirs) {
    const fs::path path = dir / (name + ".yaml");
    if (fs::exists(path)) return load_cost_table(path);
  }
  return fail(
      "compute table '" + name +
      "' not found; expected 'default', 'profiled', 'reference', 'free', 'this-machine' (after "
      "'canopeer calibrate'), or a .yaml file");
}

}  // namespace

Expected<MissionFile> load_mission(const fs::path& path, const Overrides& overrides,
                                   const std::vector<fs::path>& table_dirs,
                                   const Registries& registries) {
  auto file = YamlMap::load(path);
  if (!file) return tl::unexpected(file.error());
  auto ros2_file = set_overrides(*file, overrides);
  if (!ros2_file) return tl::unexpected(ros2_file.error());
  MissionFile result;
  MissionOptions& mission = result.mission;
  VmpOptions& vmp = mission.planners.vmp;
  mission.name = file->text("name", path.stem().string());
  result.robot = path.parent_path() / file->required_text("robot");
  if (auto ok = apply_protocol(*file, overrides, mission); !ok) return tl::unexpected(ok.error());
  mission.planner = file->choice("planner", mission.planner, registries.planners.names());
  mission.seed = static_cast<std::uint64_t>(file->number("seed", 1, {0, 9007199254740992.0}));
  // The published system is as fast as it was, unless asked otherwise.
  if (mission.planner == "vmp_released") result.compute_table = "reference";
  result.compute_table = file->text("compute_table", result.compute_table);
  read_segments(*file, mission);
  if (auto ok = read_world(file->map("world"), result.world); !ok) {
    return tl::unexpected(ok.error());
  }
  read_camera(file->map("camera"), result);
  read_noise(*file, result.simulation.sensor, mission.detector);
  read_frames(*file, result.simulation.camera, result.simulation.sensor.motion.exposure_s,
              registries.planners.manners(mission.planner), mission);
  read_rules(*file, mission);
  read_map(file->map("map"), mission);
  read_view_sampling(file->map("view_sampling"), vmp.builder);
  read_graph(file->map("graph"), vmp.builder);
  read_search(file->map("search"), vmp);
  read_execution(file->map("execution"), vmp);
  read_nbs(file->map("nbs"), mission.planners.nbs);
  read_nbv(file->map("nbv"), mission.planners.nbv);
  read_rvp(file->map("rvp"), mission.planners.rvp);
  read_coverage(file->map("coverage"), mission.planners.coverage);
  read_sweep(file->map("sweep"), mission.planners.sweep);
  read_drive_by(file->map("drive_by"), mission.planners.drive_by);
  read_playback(file->map("playback"), mission.planners.playback);
  read_gomvp(file->map("gomvp"), mission.planners.gomvp);
  read_collision(file->map("collision"), mission.collision);
  read_detector(file->map("detector"), path.parent_path(), registries.detectors.names(),
                mission.detector);
  check_labels(*file, mission.detector);
  mission.planners.own = read_own(file->map("own_planner"));
  mission.detector.own = read_own(file->map("own_detector"));
  read_fruit(*file, mission.fruit);
  result.simulation.arrival_error_rad =
      file->map("simulation").number("arrival_error_rad", 0.0, {0.0, 0.2});
  result.simulation.seed = mission.seed;
  result.ros2 = read_ros2(*file, *ros2_file);
  if (auto done = file->finish(); !done) return tl::unexpected(done.error());
  if (*ros2_file) {
    if (auto done = (*ros2_file)->finish(); !done) return tl::unexpected(done.error());
  }
  auto costs = find_cost_table(result.compute_table, path.parent_path(), table_dirs);
  if (!costs) return fail_in(file->where("compute_table"), costs.error());
  mission.costs = *costs;
  result.settings_json = file->settings_json();
  if (*ros2_file) {
    result.settings_json = joined_json(result.settings_json, (*ros2_file)->settings_json());
  }
  return result;
}

}  // namespace canopeer
