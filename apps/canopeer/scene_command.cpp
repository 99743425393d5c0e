#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/sha256.h"
#include "canopeer/import/frozen_scene.h"
#include "canopeer/import/scene_glb.h"
#include "canopeer/render/overview.h"
#include "canopeer/render/renderer.h"
#include "canopeer/render/rgbd_sensor.h"
#include "canopeer/scene/ground_truth_csv.h"
#include "canopeer/scene/ground_truth_json.h"
#include "canopeer/sensing/png.h"
#include "commands.h"
#include "exit_status.h"
#include "robot_source.h"
#include "scene_source.h"
#include "world_builder.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

/// Colour of a class in a label picture.
Rgb label_color(std::uint8_t kind) {
  switch (static_cast<PartClass>(kind)) {
    case PartClass::leaf:
      return {70, 140, 60};
    case PartClass::stem:
      return {150, 180, 90};
    case PartClass::fruit:
      return {230, 50, 40};
    case PartClass::calyx:
      return {40, 200, 120};
    case PartClass::structure:
      return {120, 120, 125};
    case PartClass::distractor:
      return {240, 190, 40};
    case PartClass::support:
      return {235, 235, 240};
  }
  return {0, 0, 0};
}

void write_view(const fs::path& out, const std::string& name, const RgbdFrame& frame,
                const RenderedView& view) {
  value_or_stop(write_png(out / (name + "_color.png"), frame.color), kFailed);
  value_or_stop(write_depth_png(out / (name + "_depth.png"), frame.depth), kFailed);
  ColorImage labels(view.color.width(), view.color.height());
  for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
    labels.pixels()[i] = label_color(view.labels.kind.pixels()[i]);
  }
  value_or_stop(write_png(out / (name + "_labels.png"), labels), kFailed);
}

fs::path out_or_stop(const std::string& given) {
  const fs::path out = given.empty() ? fs::path("out") / "scene" : fs::path(given);
  std::error_code code;
  fs::create_directories(out, code);
  if (code) stop_with(kFailed, {out.string() + ": cannot make the directory: " + code.message()});
  return out;
}

void write_truth(const fs::path& out, const Scene& scene) {
  value_or_stop(write_file(out / "ground_truth.csv", ground_truth_csv(scene)), kFailed);
  value_or_stop(write_file(out / "ground_truth.json", ground_truth_json(scene)), kFailed);
}

/// What the mission's camera sees at home in each segment, with its faults; labels without.
void render_segments(const MissionFile& file, const Scene& scene, const fs::path& out) {
  const RobotModel robot = robot_of(file);
  const Renderer renderer(scene);
  RgbdSensorOptions options = file.simulation.sensor;
  options.intrinsics = file.simulation.camera;
  options.seed = file.simulation.seed;
  const RgbdSensor sensor(renderer, scene, options);
  constexpr std::size_t kMost = 32;  // pictures of a long row tell little more
  for (std::size_t i = 0; i < std::min(file.mission.segments.size(), kMost); ++i) {
    const SegmentPlan& segment = file.mission.segments[i];
    const Pose T_world_camera =
        robot.T_world_base(segment.trolley) *
        robot.T_base_camera(robot.home("side_" + std::to_string(segment.side)));
    write_view(out, "segment_" + std::to_string(i + 1), sensor.capture(T_world_camera, i),
               renderer.render(options.intrinsics, T_world_camera));
  }
}

}  // namespace

/// The whole row from outside, and what the camera sees at home in each segment.
void scene_render(const SceneArguments& arguments) {
  const SceneSource source = load_scene_source(arguments.mission);
  const ImportedScene world = build_world_or_stop(source.world, source.seed);
  const fs::path out = out_or_stop(arguments.out);
  value_or_stop(write_png(out / "row.png", render_overview(world.scene, 1280, 720)), kFailed);
  if (source.mission) render_segments(*source.mission, world.scene, out);
  write_truth(out, world.scene);
  std::printf("%s\n", out.c_str());
}

/// The scene as files: meshes, ground truth, a picture.
void scene_generate(const SceneArguments& arguments) {
  const SceneSource source = load_scene_source(arguments.mission);
  const ImportedScene world = build_world_or_stop(source.world, source.seed);
  const fs::path out = out_or_stop(arguments.out);
  value_or_stop(write_scene_glb(out / "scene.glb", world.scene), kFailed);
  write_truth(out, world.scene);
  value_or_stop(write_png(out / "scene.png", render_overview(world.scene, 1280, 720)), kFailed);
  std::printf("%s\n", out.c_str());
}

/// The scene as one file that stays what it is, and its ground truth beside it.
void scene_freeze(const SceneArguments& arguments) {
  const SceneSource source = load_scene_source(arguments.mission);
  const ImportedScene world = build_world_or_stop(source.world, source.seed);
  const SceneFileOptions options{arguments.grid_mm / 1e3};
  Scene frozen = value_or_stop(frozen_scene(world.scene, options), kFailed);
  fs::path out = arguments.out;
  if (out.extension() != kSceneFileEnding) out += kSceneFileEnding;
  frozen.name = out.stem().string();
  if (out.has_parent_path()) static_cast<void>(out_or_stop(out.parent_path().string()));
  const std::string bytes = value_or_stop(scene_bytes(frozen, options), kFailed);
  value_or_stop(write_file(out, bytes), kFailed);
  value_or_stop(write_file(fs::path(out).replace_extension(".truth.csv"), ground_truth_csv(frozen)),
                kFailed);
  std::printf("%s  %s\n%zu bytes, %zu triangles, %zu fruits (%d count)\n",
              sha256_hex(bytes).c_str(), out.c_str(), bytes.size(), frozen.triangle_count(),
              frozen.fruits.size(), frozen.counted_fruits());
}

}  // namespace canopeer::app
