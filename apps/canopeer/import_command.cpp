#include <cstdio>
#include <filesystem>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/scan_rows_file.h"
#include "canopeer/import/scene_glb.h"
#include "canopeer/render/overview.h"
#include "canopeer/scene/ground_truth_csv.h"
#include "canopeer/sensing/png.h"
#include "commands.h"
#include "exit_status.h"
#include "fuel_caches.h"
#include "world_builder.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

WorldSource source_of(const ImportArguments& arguments) {
  WorldSource source;
  if (is_scan_rows_file(arguments.world)) {
    source.scans = value_or_stop(load_scan_rows(arguments.world), kBadInput);
    return source;
  }
  source.import.file = arguments.world;
  source.import.model_paths.assign(arguments.model_paths.begin(), arguments.model_paths.end());
  source.import.fuel_caches = fuel_caches();
  source.import.patterns = arguments.patterns;
  source.import.honour_up_axis = !arguments.ignore_up_axis;
  source.import.fruits.min_hull_cm3 = arguments.min_fruit_cm3;
  return source;
}

/// How big the world is: a wrong unit shows at once.
void say_extents(const Scene& scene) {
  const auto say = [](const char* what, const Box& box) {
    if (box.isEmpty()) return;
    const Vec3 size = box.sizes();
    std::fprintf(stderr,
                 "extents of %s: %.4g x %.4g x %.4g m (x %.4g ... %.4g, y %.4g ... %.4g, "
                 "z %.4g ... %.4g)\n",
                 what, size.x(), size.y(), size.z(), box.min().x(), box.max().x(), box.min().y(),
                 box.max().y(), box.min().z(), box.max().z());
  };
  say("all", scene.bounds());
  say("the plants", scene.bounds(true));
}

}  // namespace

/// A world or mesh as a scene file, its ground truth, what became of its names, and a picture.
void scene_import(const ImportArguments& arguments) {
  const ImportedScene world = build_world_or_stop(source_of(arguments), 1, DetectorOptions());
  say_extents(world.scene);
  const fs::path out = arguments.out;
  std::error_code code;
  fs::create_directories(out, code);
  if (code) stop_with(kFailed, {out.string() + ": cannot make the directory: " + code.message()});
  value_or_stop(write_scene_glb(out / "scene.glb", world.scene), kFailed);
  value_or_stop(write_file(out / "ground_truth.csv", ground_truth_csv(world.scene)), kFailed);
  value_or_stop(write_file(out / "parts.csv", parts_csv(world)), kFailed);
  value_or_stop(write_png(out / "scene.png", render_overview(world.scene, 1280, 720)), kFailed);
  std::printf("%s\n", out.c_str());
}

}  // namespace canopeer::app
