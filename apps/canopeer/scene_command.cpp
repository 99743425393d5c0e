#include <cstdio>
#include <filesystem>
#include <set>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/render/overview.h"
#include "canopeer/render/renderer.h"
#include "canopeer/scene/ground_truth_csv.h"
#include "canopeer/sensing/png.h"
#include "commands.h"
#include "exit_status.h"
#include "mission_arguments.h"
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
  }
  return {0, 0, 0};
}

void write_view(const fs::path& out, const std::string& name, const RenderedView& view) {
  value_or_stop(write_png(out / (name + "_color.png"), view.color), kFailed);
  value_or_stop(write_depth_png(out / (name + "_depth.png"), view.depth), kFailed);
  ColorImage labels(view.color.width(), view.color.height());
  for (std::size_t i = 0; i < labels.pixels().size(); ++i) {
    labels.pixels()[i] = label_color(view.labels.kind.pixels()[i]);
  }
  value_or_stop(write_png(out / (name + "_labels.png"), labels), kFailed);
}

}  // namespace

/// The whole row from outside, and what the camera sees at home in each segment.
void scene_render(const SceneArguments& arguments) {
  const MissionFile file = load(arguments.mission);
  const RobotModel robot = value_or_stop(load_robot(file.robot), kBadInput);
  const ImportedScene world = build_world_or_stop(file.world, file.mission.seed, false);
  const Scene& scene = world.scene;
  const Renderer renderer(scene);
  const fs::path out = arguments.out.empty() ? fs::path("out") / "scene" : fs::path(arguments.out);
  std::error_code code;
  fs::create_directories(out, code);
  if (code) stop_with(kFailed, {out.string() + ": cannot make the directory: " + code.message()});
  value_or_stop(write_png(out / "row.png", render_overview(scene, 1280, 720)), kFailed);
  for (std::size_t i = 0; i < file.mission.segments.size(); ++i) {
    const SegmentPlan& segment = file.mission.segments[i];
    const Pose T_world_camera =
        robot.T_world_base(segment.trolley) *
        robot.T_base_camera(robot.home("side_" + std::to_string(segment.side)));
    write_view(out, "segment_" + std::to_string(i + 1),
               renderer.render(file.simulation.camera, T_world_camera));
  }
  value_or_stop(write_file(out / "ground_truth.csv", ground_truth_csv(scene)), kFailed);
  std::printf("%s\n", out.c_str());
}

void scene_inspect(const SceneArguments& arguments) {
  const MissionFile file = load(arguments.mission);
  const ImportedScene world = build_world_or_stop(file.world, file.mission.seed, false);
  const Scene& scene = world.scene;
  std::set<int> plants;
  for (const ScenePart& part : scene.parts) {
    if (part.plant >= 0) plants.insert(part.plant);
  }
  int by_class[3] = {0, 0, 0};
  for (const auto& fruit : scene.fruits) ++by_class[static_cast<int>(fruit.ripeness)];
  std::printf(
      "scene             %s, seed %llu\nplants            %zu\ntriangles         %zu\n"
      "fruits_counted    %d\nfruits_total      %zu (%d ripe, %d turning, %d green)\n",
      scene.name.c_str(), static_cast<unsigned long long>(scene.seed), plants.size(),
      scene.triangle_count(), scene.counted_fruits(), scene.fruits.size(),
      by_class[static_cast<int>(Ripeness::ripe)], by_class[static_cast<int>(Ripeness::turning)],
      by_class[static_cast<int>(Ripeness::green)]);
}

}  // namespace canopeer::app
