#include <CLI/CLI.hpp>

#include "mission_arguments.h"
#include "options.h"

namespace canopeer::app {
namespace {

void add_import(CLI::App& scene, ImportArguments& arguments) {
  CLI::App* command = scene.add_subcommand(
      "import", "Read a world or mesh that is there already; write scene, ground truth, picture");
  command->add_option("world", arguments.world, "SDF world, mesh, or scene file of scanned plants")
      ->required();
  command
      ->add_option("--model-path", arguments.model_paths,
                   "Folder of models, for model:// (repeatable)")
      ->expected(1)
      ->take_all();
  command->add_option("--fruit", arguments.patterns.fruit,
                      "Pattern on the names of what is fruit: material, texture, mesh or model");
  command->add_option("--counted", arguments.patterns.counted,
                      "Pattern on the names of fruits that count (default: all)");
  command->add_option("--leaf", arguments.patterns.leaf, "Pattern on the names of leaves");
  command->add_option("--stem", arguments.patterns.stem,
                      "Pattern on the names of stems (default: what else is in a plant)");
  command->add_option("--plant", arguments.patterns.plant,
                      "Pattern on models that are plants though nothing in them matches");
  command->add_option("--skip", arguments.patterns.skip,
                      "Pattern on the names of what to leave out");
  command->add_option("--min-fruit-cm3", arguments.min_fruit_cm3,
                      "Smaller pieces of fruit surface are no fruits");
  command->add_flag("--ignore-up-axis", arguments.ignore_up_axis,
                    "Take COLLADA coordinates as they are, as Gazebo does");
  command->add_option("--out", arguments.out, "Directory for the results")->required();
  command->callback([&arguments] { scene_import(arguments); });
}

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

}  // namespace canopeer::app
