#include "canopeer/program.h"

#include <fcntl.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "canopeer/config/protocols.h"
#include "commands.h"
#include "completion.h"
#include "exit_status.h"
#include "manual.h"
#include "mission_arguments.h"
#ifdef CANOPEER_ROS2
#include "canopeer/ros2/ros2_site.h"
#include "ros2_commands.h"
#include "ros2_words.h"
#endif
#include "shipped_data.h"

namespace canopeer::app {
namespace {

std::string comma_list(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::vector<std::string> protocol_names() {
  std::vector<std::string> names;
  for (const Protocol& protocol : protocols()) names.push_back(protocol.name);
  return names;
}

void add_run(CLI::App& app, RunArguments& arguments, const RunRegistries& registries) {
  CLI::App* command = app.add_subcommand("run", "Run a mission and write the results");
  add_mission(*command, arguments.mission);
  command->add_option("--planner", arguments.planner,
                      "Planner: " + comma_list(registries.planners.names()));
  command->add_option("--protocol", arguments.protocol,
                      "Rules by name, in place of the mission's: " + comma_list(protocol_names()));
  command->add_option("--yardstick", arguments.yardstick,
                      "Give results as shares of this too (JSON, as `bound` writes it)");
  command->add_option("--site", arguments.site,
                      "What stands behind the ports: " + comma_list(registries.sites.names()));
  command->add_option("--segments", arguments.segments, "Only the first K segments");
  command->add_option("--time-per-segment", arguments.time_per_segment_s, "Seconds per segment");
  command->add_option("--threads", arguments.threads, "Threads at most (0: all cores)")
      ->check(CLI::Range(0, 1024));
  command->add_option("--compute-table", arguments.compute_table,
                      "What computing costs: default, reference, free, this-machine, or a file");
  command->add_flag("--realtime", arguments.realtime,
                    "On the wall clock, with worker threads, in place of simulated time");
  command->add_flag("--view", arguments.view.view,
                    "Serve a page that shows the run; its address is printed");
  command->add_option("--view-port", arguments.view.port, "Port of the page (0: any)");
  command->add_option(
      "--view-bind", arguments.view.address,
      "Address of the page; 0.0.0.0: other machines with the printed link may look");
  command->add_flag("!--no-replay", arguments.view.replay, "Leave out what `canopeer view` needs");
  command->add_flag("--dry-run", arguments.dry_run,
                    "Site ros2: plan and tell, and never move (ros2.dry_run)");
  command->add_flag("--confirm", arguments.confirm,
                    "Site ros2: ask before every motion (ros2.confirm)");
  command->add_option("--out", arguments.out, "Directory for the results");
  command->add_flag("--quiet", arguments.quiet, "Print errors only");
  command->add_flag("--profile", arguments.profile, "Print where the wall time went");
  command->callback([&arguments] { run(arguments); });
}

void add_suite(CLI::App& bench, SuiteArguments& a) {
  CLI::App* command = bench.add_subcommand(
      "suite",
      "Run planners on CanopeerBench, 24 frozen worlds; write one page, one file to hand in");
  command->add_option("--planners", a.planners, "Planners, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--split", a.split, "Which worlds: train, validation, test or all")
      ->check(CLI::IsMember({"train", "validation", "test", "all"}))
      ->capture_default_str();
  command->add_option("--worlds", a.worlds, "Only these, separated by commas")->delimiter(',');
  command->add_option("--protocols", a.protocols, "Rules of the runs, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--seeds", a.seeds, "Runs per planner and world: seeds 1 to N")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--set", a.settings, "Override a setting in all runs; such are no entries")
      ->expected(1)
      ->take_all();
  command->add_option("--jobs", a.jobs, "Runs at a time, each a process")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--threads", a.threads, "Threads of each run (0: the cores shared out)")
      ->check(CLI::Range(0, 1024));
  command->add_option("--shard", a.shard, "i/n: make every n-th run only, from the i-th");
  command->add_option("--out", a.out, "Folder of the runs, the page and results.json");
  command->add_flag("--report-only", a.report_only, "Take the runs that are there; make none");
  command->add_flag("--quiet", a.quiet, "Print errors only");
  command->add_option("--check", a.check,
                      "Say whether a results.json is a valid entry; run nothing");
  command->callback([&a] { bench_suite(a); });
}

void add_bench(CLI::App& app, BenchArguments& a, SuiteArguments& suite, VerifyArguments& verify) {
  CLI::App* command = app.add_subcommand(
      "bench",
      "Compare planners on the same worlds and seeds; the same command goes on after a kill");
  command->add_option("missions", a.missions, "Mission files (YAML), or names of shipped ones");
  command
      ->add_option("--planners", a.planners,
                   "Planners, each as NAME or NAME@COMPUTE-TABLE, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--runs", a.runs, "Seeds per planner and mission")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--first-seed", a.first_seed, "The first of them")->capture_default_str();
  command
      ->add_option("--budgets", a.budgets_s,
                   "Seconds per segment, separated by commas; each is a run of its own")
      ->delimiter(',')
      ->check(CLI::Range(1.0, 36000.0));
  command
      ->add_option("--protocols,--protocol", a.protocols,
                   "Rules by name, separated by commas, each a comparison of its own: tight, " +
                       comma_list(protocol_names()))
      ->delimiter(',');
  command->add_option("--yardsticks", a.yardsticks,
                      "Folder of yardsticks (MISSION/seed_N/PROTOCOL.json) to hold runs against");
  command->add_option("--segments", a.segments, "Only the first K segments")
      ->check(CLI::Range(1, 100000));
  command->add_option("--set", a.settings, "Override a setting in all runs (repeatable)")
      ->expected(1)
      ->take_all();
  command->add_option("--jobs", a.jobs, "Runs at a time, each a process")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--threads", a.threads, "Threads of each run (0: the cores shared out)")
      ->check(CLI::Range(0, 1024));
  CLI::Option* shard = command->add_option(
      "--shard", a.shard,
      "i/n: make every n-th run only, from the i-th (several machines, one folder)");
  command
      ->add_option("--merge", a.merge,
                   "Join the runs of this folder, made by the same command on another machine, "
                   "into --out; make none (repeatable)")
      ->expected(1)
      ->take_all()
      ->excludes(shard);
  command->add_option("--out", a.out, "Folder of the runs and the comparison");
  command->add_flag("--keep-maps", a.keep_maps, "Keep each run's maps and pictures");
  command->add_flag("--report-only", a.report_only, "Compare the runs that are there; make none");
  command->add_flag("--quiet", a.quiet, "Print errors only");
  CLI::Option* records =
      command->add_option("--verify-records", verify.records,
                          "Run every best known result again and compare (default: records/)");
  records->expected(0, 1);
  add_suite(*command, suite);
  command->callback([&a, &verify, command, records] {
    if (!command->get_subcommands().empty()) return;
    if (records->count() > 0) {
      verify.out = a.out;
      verify.jobs = a.jobs;
      return verify_records(verify);
    }
    if (a.missions.empty()) throw CLI::RequiredError("missions");
    if (a.out.empty()) throw CLI::RequiredError("--out");
    bench(a);
  });
}

void add_bound(CLI::App& app, BoundArguments& a) {
  CLI::App* command = app.add_subcommand(
      "bound",
      "Say how good a run of a mission could be: what can be seen at all, the best plan of one who "
      "knows the world, and bounds; the same command goes on after a stop");
  add_mission(*command, a.mission);
  command->add_option("--protocol", a.protocol, "Rules by name (default: the mission's own)");
  command->add_option("--out", a.out, "Directory for the results")->required();
  command->add_option("--pool", a.pool,
                      "File of the sampled views, used again where it fits (default: views.pool in "
                      "--out); it does not depend on the protocol");
  command->add_option("--record", a.record,
                      "Record to put the results into, e.g. records/dense_1/seed_1/tight10.json; "
                      "better ones that are there stay");
  command->add_option("--segments", a.segments, "Only the first K segments")
      ->check(CLI::Range(1, 100000));
  command
      ->add_option("--views-per-fruit", a.views_per_fruit,
                   "Sampled views aimed at each fruit in range, at least")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--views-per-segment", a.most_views, "Sampled views a segment, at most")
      ->check(CLI::Range(1, 100000000));
  command
      ->add_option("--find-area", a.min_area_cm2,
                   "A fruit may count as found when so many cm2 of it have been seen")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_flag("!--no-pipeline", a.pipeline,
                    "Do not feed the frames of a set cover to the fruit map");
  command->add_flag("!--no-plans", a.plans, "No plans of one who knows the world");
  command->add_option("--threads", a.threads, "Threads at most (0: all cores)")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--quiet", a.quiet, "Print errors only");
  command->callback([&a] { bound(a); });
}

void add_calibrate(CLI::App& app, CalibrateArguments& a) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "Measure what computing costs on this machine: compute table this-machine");
  command->add_option("mission", a.mission.path, "Mission to measure on (default: smoke)");
  command->add_option("--out", a.out, "File to write (default: where runs find it by name)");
  command->add_flag("--quiet", a.quiet, "Print errors only");
  command->callback([&a] { calibrate(a); });
}

void add_doctor(CLI::App& app, DoctorArguments& a) {
  CLI::App* command = app.add_subcommand(
      "doctor", "Say what this machine and this program have, and try the smoke mission");
  command->add_flag("--quick", a.quick, "No self-test");
  command->callback([&a] { doctor(a); });
}

void add_view(CLI::App& app, ViewArguments& arguments) {
  CLI::App* command = app.add_subcommand("view", "Show a run again in a browser, a killed one too");
  command->add_option("run", arguments.run, "Directory of the run")->required();
  command->add_option("--view-port", arguments.port, "Port of the page (0: any)");
  command->add_option(
      "--view-bind", arguments.address,
      "Address of the page; 0.0.0.0: other machines with the printed link may look");
  command->add_flag("--quiet", arguments.quiet, "Print the address only");
  command->callback([&arguments] { view(arguments); });
}

void add_report(CLI::App& app, std::string& directory) {
  CLI::App* command = app.add_subcommand("report", "Make report.html of a finished run anew");
  command->add_option("dir", directory, "The run's directory")->required();
  command->callback([&directory] { report(directory); });
}

void add_import(CLI::App& scene, ImportArguments& arguments) {
  CLI::App* import = scene.add_subcommand(
      "import", "Read a world or mesh that is there already; write scene, ground truth, picture");
  import->add_option("world", arguments.world, "SDF world, mesh, or scene file of scanned plants")
      ->required();
  import
      ->add_option("--model-path", arguments.model_paths,
                   "Folder of models, for model:// (repeatable)")
      ->expected(1)
      ->take_all();
  import->add_option("--fruit", arguments.patterns.fruit,
                     "Pattern on the names of what is fruit: material, texture, mesh or model");
  import->add_option("--counted", arguments.patterns.counted,
                     "Pattern on the names of fruits that count (default: all)");
  import->add_option("--leaf", arguments.patterns.leaf, "Pattern on the names of leaves");
  import->add_option("--stem", arguments.patterns.stem,
                     "Pattern on the names of stems (default: what else is in a plant)");
  import->add_option("--plant", arguments.patterns.plant,
                     "Pattern on models that are plants though nothing in them matches");
  import->add_option("--skip", arguments.patterns.skip,
                     "Pattern on the names of what to leave out");
  import->add_option("--min-fruit-cm3", arguments.min_fruit_cm3,
                     "Smaller pieces of fruit surface are no fruits");
  import->add_flag("--ignore-up-axis", arguments.ignore_up_axis,
                   "Take COLLADA coordinates as they are, as Gazebo does");
  import->add_option("--out", arguments.out, "Directory for the results")->required();
  import->callback([&arguments] { scene_import(arguments);
});
}  // namespace

void add_scene(CLI::App& app, SceneArguments& arguments, ImportArguments& import_arguments) {
  CLI::App* scene = app.add_subcommand("scene", "Look at the world of a mission, or bring one");
  scene->require_subcommand(1);
  CLI::App* render = scene->add_subcommand(
      "render", "Write pictures of the row and of what the camera sees, and the ground truth");
  add_mission(*render, arguments.mission);
  render->add_option("--out", arguments.out, "Directory for the pictures");
  render->callback([&arguments] { scene_render(arguments); });
  CLI::App* generate = scene->add_subcommand(
      "generate", "Write the world of a mission or scene file: meshes, ground truth, a picture");
  add_mission(*generate, arguments.mission);
  generate->add_option("--out", arguments.out, "Directory for the files")->required();
  generate->callback([&arguments] { scene_generate(arguments); });
  CLI::App* inspect = scene->add_subcommand(
      "inspect",
      "Print what is in the world of a mission or scene file, and how hidden fruits are");
  add_mission(*inspect, arguments.mission);
  inspect->add_option("--json", arguments.json, "Write the same figures to this file");
  inspect->add_flag("--counts", arguments.counts_only, "Leave out how hidden the fruits are");
  inspect->callback([&arguments] { scene_inspect(arguments); });
  CLI::App* freeze = scene->add_subcommand(
      "freeze",
      "Write the world as one file that stays what it is (.cscene), and its ground truth");
  add_mission(*freeze, arguments.mission);
  freeze->add_option("--out", arguments.out, "File to write: NAME.cscene; NAME.truth.csv beside it")
      ->required();
  freeze->add_option("--grid-mm", arguments.grid_mm, "Grid that vertices are put on")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  freeze->callback([&arguments] { scene_freeze(arguments); });
  add_import(*scene, import_arguments);
}

void add_fruit(CLI::App& app, FruitFitArguments& a) {
  CLI::App* fruit = app.add_subcommand("fruit", "Fruits from point clouds of your own");
  fruit->require_subcommand(1);
  CLI::App* fit = fruit->add_subcommand(
      "fit", "Find the fruits in a cloud of fruit surface, fit their shapes, write the fruit map");
  fit->add_option("cloud", a.cloud,
                  "Points: .ply, .pcd, or text (.csv, .txt, .xyz, .asc, .pts); normals and colours "
                  "optional")
      ->required();
  fit->add_option("--out", a.out, "Directory for the results")->required();
  fit->add_option("--unit", a.unit, "What the coordinates are in")
      ->check(CLI::IsMember({"m", "cm", "mm"}))
      ->capture_default_str();
  fit->add_flag("--any-pose", a.any_pose, "z is not up, or the fruits do not hang");
  fit->add_option("--min-confidence", a.min_confidence, "Less likely fruits are left out")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  fit->callback([&a] { fruit_fit(a); });
}

struct MapArguments {
  std::string in;
  std::string out;
  MapFuseArguments fuse;
};

void add_map_fuse(CLI::App& map, MapFuseArguments& a) {
  CLI::App* fuse = map.add_subcommand(
      "fuse", "Make a map of a recording: a TUM RGB-D sequence, or a folder of .ply/.pcd clouds");
  fuse->add_option("dataset", a.dataset, "The recording's folder")->required();
  fuse->add_option("--out", a.out, "Map to write: .cmap, .ot, .bt or .ply")->required();
  fuse->add_option("--resolution", a.resolution_m, "Side of a voxel in metres")
      ->check(CLI::Range(0.0005, 10.0))
      ->capture_default_str();
  fuse->add_option("--max-range", a.max_range_m, "Farther points only free space; metres")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  fuse->add_flag("--clear-no-return", a.clear_no_return,
                 "Pixels without depth free space up to --max-range (images, not clouds)");
  fuse->add_option("--every", a.every, "Take every N-th frame only")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  fuse->add_option("--threads", a.threads, "Threads at most (0: all cores)")
      ->check(CLI::Range(0, 1024));
  fuse->add_option("--camera", a.camera,
                   "Camera file (YAML); default: camera.yaml in the recording's folder");
  fuse->add_option("--intrinsics", a.intrinsics, "FX,FY,CX,CY in pixels, instead of a camera file")
      ->delimiter(',')
      ->expected(4);
  fuse->add_option("--depth-factor", a.depth_units_per_m,
                   "What a metre is in the depth images; default: the camera file's, or 5000")
      ->check(CLI::Range(1e-3, 1e9));
  fuse->add_option("--trajectory", a.trajectory,
                   "Poses `timestamp tx ty tz qx qy qz qw`, or columns that its first line names; "
                   "default: the recording's own");
  fuse->add_option("--max-gap", a.max_pose_gap_s,
                   "Seconds that poses may lie apart to interpolate between them")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  fuse->add_option("--max-difference", a.max_difference_s,
                   "Seconds between a depth image and its colour image")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  fuse->add_option("--roi", a.roi, "Which points are fruit: none, or color (by colour images)")
      ->check(CLI::IsMember({"none", "color"}))
      ->capture_default_str();
  fuse->add_flag("--strict", a.strict, "A frame without a pose is an error, not passed over");
  fuse->add_flag("--quiet", a.quiet, "Print errors only");
  fuse->callback([&a] { map_fuse(a); });
}

void add_map(CLI::App& app, MapArguments& arguments) {
  CLI::App* map = app.add_subcommand("map", "Look at maps, convert them, make them of recordings");
  map->require_subcommand(1);
  CLI::App* info = map->add_subcommand("info", "Print what is in a map file (.cmap, .ot, .bt)");
  info->add_option("file", arguments.in, "The map")->required();
  info->callback([&arguments] { map_info(arguments.in); });
  CLI::App* convert = map->add_subcommand(
      "convert", "Write a map in another format, by the ending; ROI trees lie beside as NAME_roi");
  convert->add_option("in", arguments.in, "Map to read: .cmap, .ot or .bt")->required();
  convert->add_option("out", arguments.out, "Map to write: .cmap, .ot, .bt or .ply")->required();
  convert->callback([&arguments] { map_convert(arguments.in, arguments.out); });
  add_map_fuse(*map, arguments.fuse);
}

void add_robot(CLI::App& app, RobotCheckArguments& a) {
  CLI::App* robot = app.add_subcommand("robot", "Look at the description of a robot");
  robot->require_subcommand(1);
  CLI::App* check = robot->add_subcommand(
      "check", "Say what a robot's files describe and what is wrong; write pictures and an SRDF");
  check->add_option("robot", a.robot, "The robot.yaml")->required();
  check->add_option("--out", a.out, "Directory for the results (default: out/robot)");
  check->add_option("--views", a.views, "Random views a side to reach for")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  check->add_option("--states", a.states, "Random states in which links may touch")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  check->callback([&a] { robot_check(a); });
}

void add_manual(CLI::App& app, ManualArguments& a) {
  CLI::App* command = app.add_subcommand(
      "manual", "Print the manual page of the program or of a command; read it with man -l -");
  command->add_option("command", a.command, "The command");
  command->add_option("--all", a.folder, "Write all pages into this folder, as man1/NAME.1");
  command->callback([&app, &a] { manual(app, a); });
}

/// What a shell may offer for the words of an unfinished command line.
void complete(const CLI::App& app, const RunRegistries& registries,
              const std::vector<std::string>& words) {
  CompletionNames names;
  names.missions = shipped_missions();
  names.planners = registries.planners.names();
  names.sites = registries.sites.names();
  names.compute_tables = {"default", "reference", "free", "this-machine"};
  for (const std::string& line : completions(app, names, words)) std::printf("%s\n", line.c_str());
}

/// A program started with one of them closed would take its first file for it. Whole lines go out
/// at once, so that they stand before what standard error says later.
void open_standard_streams() {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  for (int stream = 0; stream <= 2; ++stream) {
    if (fcntl(stream, F_GETFD) == -1) static_cast<void>(open("/dev/null", O_RDWR));
  }
}

/// Every command may name what is registered.
int parse_and_run(int argc, char** argv, const RunRegistries& registries) {
  CLI::App app{
      "Plans where a robot's camera looks next, so that every fruit behind the leaves is found."};
  app.require_subcommand(1);
  RunArguments run_arguments;
  std::string report_directory;
  ViewArguments view_arguments;
  SceneArguments scene_arguments;
  ImportArguments import_arguments;
  run_arguments.mission.registries = &registries;
  add_run(app, run_arguments, registries);
  BenchArguments bench_arguments;
  BoundArguments bound_arguments;
  CalibrateArguments calibrate_arguments;
  bench_arguments.registries = &registries;
  bound_arguments.mission.registries = &registries;
  calibrate_arguments.mission.registries = &registries;
  scene_arguments.mission.registries = &registries;
  SuiteArguments suite_arguments;
  suite_arguments.registries = &registries;
  VerifyArguments verify_arguments;
  add_bench(app, bench_arguments, suite_arguments, verify_arguments);
  add_bound(app, bound_arguments);
  add_calibrate(app, calibrate_arguments);
  add_report(app, report_directory);
  add_view(app, view_arguments);
  add_scene(app, scene_arguments, import_arguments);
  FruitFitArguments fruit_arguments;
  add_fruit(app, fruit_arguments);
  MapArguments map_arguments;
  add_map(app, map_arguments);
  RobotCheckArguments robot_arguments;
  add_robot(app, robot_arguments);
#ifdef CANOPEER_ROS2
  Ros2Arguments ros2_arguments;
  const ros::RosArguments ros_arguments = take_ros_arguments(argc, argv);
  ros2_arguments.robot.node = ros_arguments.node.value_or(ros2_arguments.robot.node);
  ros2_arguments.robot.mission.ros2 = ros2_settings(ros_arguments, ros2_arguments.robot.node);
  run_arguments.mission.ros2 = ros2_settings(ros_arguments, Ros2Settings().node);
  ros2_arguments.check.mission.ros2 = run_arguments.mission.ros2;
  add_ros2(app, ros2_arguments, registries);
  std::vector<std::string> words(ros_arguments.rest.rbegin(), ros_arguments.rest.rend() - 1);
#else
  std::vector<std::string> words(std::make_reverse_iterator(argv + argc),
                                 std::make_reverse_iterator(argv + 1));
#endif
  DoctorArguments doctor_arguments;
  doctor_arguments.registries = &registries;
  add_doctor(app, doctor_arguments);
  app.set_version_flag("--version", std::string("canopeer ") + CANOPEER_VERSION);
  app.footer(std::string("Exit status: ") + kExitStatusText);
  ManualArguments manual_arguments;
  add_manual(app, manual_arguments);
  app.add_subcommand("version", "Print the version")->callback([] {
    std::printf("canopeer %s\n", CANOPEER_VERSION);
  });
  if (argc > 1 && std::string(argv[1]) == "complete") {
    complete(app, registries, {argv + 2, argv + argc});
    return kDone;
  }
  try {
    app.name(argv[0]);
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    std::fflush(stdout);
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  return kDone;
}

}  // namespace canopeer::app
}  // namespace canopeer::app

namespace canopeer {

int run_program(int argc, char** argv, const RunRegistries& with) {
  app::open_standard_streams();
  RunRegistries registries = with;
#ifdef CANOPEER_ROS2
  add_ros2_site(registries.sites);
#endif
  try {
    const int status = app::parse_and_run(argc, argv, registries);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    std::fprintf(stderr, "canopeer: cannot write to standard output\n");
    return status == app::kDone ? app::kFailed : status;
  } catch (const app::Stop& stop) {
    return stop.status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "canopeer: internal error: %s\n", error.what());
    return app::kFailed;
  }
}

}  // namespace canopeer
