#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/config/mission_file.h"
#include "canopeer/import/world_import.h"
#include "canopeer/run/run_registries.h"

namespace canopeer::app {

/// What several commands take to name a mission and change its settings.
struct MissionArguments {
  const RunRegistries* registries = nullptr;  ///< what it may name
  std::string path;
  std::vector<std::string> settings;  ///< "dotted.key=value"
  std::optional<std::uint64_t> seed;
  Overrides ros2;  ///< settings said in ROS 2's way, before the others
};

/// What a page shows, and where it is served.
struct ViewArguments {
  std::string run;     ///< directory of a run; empty: the one that begins
  bool view = false;   ///< serve the page while it runs
  bool replay = true;  ///< write the replay beside the record
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;
  bool quiet = false;
};

struct RunArguments {
  MissionArguments mission;
  std::string planner;
  std::string protocol;   ///< empty: what the mission says
  std::string yardstick;  ///< file; empty: none
  std::optional<int> segments;
  std::optional<double> time_per_segment_s;
  std::string compute_table;
  std::string site = "simulation";
  ViewArguments view;
  int threads = 0;  ///< 0: all cores
  bool realtime = false;
  bool dry_run = false;  ///< of a robot
  bool confirm = false;  ///< of a robot
  std::string out;
  bool quiet = false;
  bool profile = false;
};

struct SceneArguments {
  MissionArguments mission;  ///< or a scene file in its place
  std::string out;
  std::string json;  ///< empty: no such file
  bool counts_only = false;
  double grid_mm = 0.1;  ///< that the vertices of a frozen scene lie on
};

struct MapFuseArguments {
  std::string dataset;
  std::string out;
  double resolution_m = 0.01;
  double max_range_m = 3.0;
  bool clear_no_return = false;
  int every = 1;
  int threads = 0;  ///< 0: all cores
  std::string camera;
  std::vector<double> intrinsics;  ///< fx, fy, cx, cy in pixels
  std::optional<double> depth_units_per_m;
  std::string trajectory;
  double max_pose_gap_s = 0.25;
  double max_difference_s = 0.02;
  std::string roi = "none";
  bool strict = false;
  bool quiet = false;
};

struct MapArguments {
  std::string in;
  std::string out;
  MapFuseArguments fuse;
};

struct FruitFitArguments {
  std::string cloud;
  std::string out;
  std::string unit = "m";
  bool any_pose = false;
  double min_confidence = 0.5;
};

struct ImportArguments {
  std::string world;
  std::vector<std::string> model_paths;
  NamePatternOptions patterns;
  double min_fruit_cm3 = FruitComponentOptions().min_hull_cm3;
  bool ignore_up_axis = false;
  std::string out;
};

/// What every campaign is told.
struct CampaignArguments {
  const RunRegistries* registries = nullptr;  ///< what the missions may name
  std::vector<std::string> planners;
  std::vector<std::string> protocols;
  std::vector<std::string> settings;
  int jobs = 1;     ///< processes at a time
  int threads = 0;  ///< of each run; 0: the cores shared among the jobs
  std::string shard;
  std::string out;
  bool report_only = false;
  bool quiet = false;
};

struct BenchArguments : CampaignArguments {
  BenchArguments() { planners = {"vmp", "vmp_released@reference", "rvp", "rvp@reference"}; }

  std::vector<std::string> missions;
  std::vector<double> budgets_s;  ///< seconds per segment; empty: the missions'
  std::string yardsticks;         ///< folder of them; empty: none
  int runs = 5;
  std::uint64_t first_seed = 1;
  std::optional<int> segments;
  std::vector<std::string> merge;  ///< folders of campaigns to join into `out`
  bool keep_maps = false;
  bool progress = false;  ///< the bar even when quiet
};

/// The suite of frozen worlds, docs/benchmark.md.
struct SuiteArguments : CampaignArguments {
  SuiteArguments() {
    planners = {"vmp", "rvp", "random"};
    protocols = {"tight10"};
  }

  std::vector<std::string> worlds;  ///< only these; empty: those of the split
  std::string split = "test";
  int seeds = 3;
  std::string check;  ///< a results file to look at, in place of runs
};

struct VerifyArguments {
  std::string records;  ///< folder; empty: the shipped one
  std::string out;      ///< where the runs are kept; empty: they are not
  int jobs = 1;
};

struct BoundArguments {
  MissionArguments mission;
  std::string protocol;  ///< empty: the mission's own rules
  std::string out;
  std::string pool;    ///< file of the sampled views; empty: views.pool in `out`
  std::string record;  ///< of records/, that learns of the results; empty: none
  std::optional<int> segments;
  std::optional<int> views_per_fruit;  ///< aimed at each fruit in range; none: the default
  std::optional<int> most_views;       ///< a segment, at most; none: the default
  std::optional<double> min_area_cm2;  ///< of the find rule; none: the default
  bool pipeline = true;                ///< frames of the cover through our own fruit map
  bool plans = true;                   ///< clairvoyant plans, executed
  int threads = 0;                     ///< 0: all cores
  bool quiet = false;
};

struct CalibrateArguments {
  MissionArguments mission;  ///< none: the smoke mission that ships with the program
  std::string out;
  bool quiet = false;
};

struct DoctorArguments {
  const RunRegistries* registries = nullptr;
  bool quick = false;  ///< no self-test
};

struct ManualArguments {
  std::string command;  ///< empty: the program
  std::string folder;   ///< write all pages there; empty: print one
};

struct RobotCheckArguments {
  std::string robot;
  std::string out;
  int views = 4000;
  int states = 10000;
};

/// What to do when something is left out of this build, as ./demo.sh leaves out what it does not
/// take.
inline constexpr const char* kWholeBuild = "scripts/build.sh release builds all of it";

// The commands. Each ends by returning, or by throwing Stop.
void run(const RunArguments& arguments);
void bench(const BenchArguments& arguments);
void bound(const BoundArguments& arguments);
void bench_suite(const SuiteArguments& arguments);
void verify_records(const VerifyArguments& arguments);
void calibrate(const CalibrateArguments& arguments);
void doctor(const DoctorArguments& arguments);
void report(const std::string& directory);
void view(const ViewArguments& arguments);
void scene_render(const SceneArguments& arguments);
void scene_inspect(const SceneArguments& arguments);
void scene_generate(const SceneArguments& arguments);
void scene_freeze(const SceneArguments& arguments);
void scene_import(const ImportArguments& arguments);
void fruit_fit(const FruitFitArguments& arguments);
void robot_check(const RobotCheckArguments& arguments);
void map_info(const std::string& file);
void map_convert(const std::string& in, const std::string& out);
void map_fuse(const MapFuseArguments& arguments);

}  // namespace canopeer::app
