#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "canopeer/base/atomic_file.h"
#include "canopeer/fruit/cloud_fruits.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/fruit/fruits_json.h"
#include "canopeer/fruit/surface_files.h"
#include "canopeer/report/fruit_gallery.h"
#include "canopeer/sensing/cloud_file.h"
#include "commands.h"
#include "exit_status.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

double metres_of(const std::string& unit) {
  return unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : 1.0;
}

/// As points of one surface, for the files that meshes go into.
SurfaceMesh points_of(const CloudFruits& fruits) {
  SurfaceMesh mesh;
  for (std::size_t i = 0; i < fruits.surface.points.size(); ++i) {
    SurfaceVertex vertex;
    vertex.surface.point = fruits.surface.points[i].cast<double>();
    vertex.surface.normal = fruits.surface.normals[i].cast<double>();
    vertex.color = fruits.surface.colors.empty() ? Rgb{160, 160, 160} : fruits.surface.colors[i];
    mesh.vertices.push_back(vertex);
  }
  mesh.fruit = fruits.fruit;
  return mesh;
}

/// The least sure first.
std::vector<GalleryFruit> gallery_of(const CloudFruits& fruits) {
  std::vector<GalleryFruit> gallery;
  for (std::size_t k = 0; k < fruits.fruits.size(); ++k) {
    GalleryFruit& item = gallery.emplace_back();
    item.estimate = fruits.fruits[k];
    item.missing = fruits.missing[k];
  }
  for (std::size_t i = 0; i < fruits.fruit.size(); ++i) {
    if (fruits.fruit[i] < 0) continue;
    GalleryFruit& item = gallery[static_cast<std::size_t>(fruits.fruit[i])];
    item.points.push_back(fruits.surface.points[i].cast<double>());
    if (!fruits.surface.colors.empty()) item.colors.push_back(fruits.surface.colors[i]);
  }
  std::stable_sort(gallery.begin(), gallery.end(), [](const auto& a, const auto& b) {
    return a.estimate.confidence < b.estimate.confidence;
  });
  return gallery;
}

Expected<void> write_all(const fs::path& out, const CloudFruits& fruits) {
  std::error_code code;
  fs::create_directories(out, code);
  if (code) return fail(out.string() + ": cannot make the directory: " + code.message());
  if (auto ok = write_file(out / "fruits.csv", fruits_csv(fruits.fruits)); !ok) return ok;
  if (auto ok = write_file(out / "fruits.json", fruits_json(fruits.fruits)); !ok) return ok;
  if (auto ok = write_surface_ply(out / "fruits.ply", points_of(fruits)); !ok) return ok;
  constexpr int kWidthPx = 880;
  return write_file(out / "fruits.svg", fruit_gallery_svg(gallery_of(fruits), kWidthPx, true));
}

/// Fruits below the confidence go; their points belong to none then.
void keep_likely(CloudFruits& fruits, double min_confidence) {
  std::vector<int> new_id(fruits.fruits.size(), -1);
  CloudFruits kept;
  for (std::size_t k = 0; k < fruits.fruits.size(); ++k) {
    if (fruits.fruits[k].confidence < min_confidence) continue;
    new_id[k] = static_cast<int>(kept.fruits.size());
    kept.fruits.push_back(fruits.fruits[k]);
    kept.fruits.back().id = new_id[k];
    kept.missing.push_back(std::move(fruits.missing[k]));
  }
  for (int& fruit : fruits.fruit) {
    if (fruit >= 0) fruit = new_id[static_cast<std::size_t>(fruit)];
  }
  fruits.fruits = std::move(kept.fruits);
  fruits.missing = std::move(kept.missing);
}

}  // namespace

void fruit_fit(const FruitFitArguments& arguments) {
  CloudFile file = value_or_stop(read_cloud(arguments.cloud), kBadInput);
  const float scale = static_cast<float>(metres_of(arguments.unit));
  for (auto& p : file.cloud.points) p *= scale;
  std::optional<Vec3> viewpoint;
  if (file.T_world_points) {
    // Points of a PCD file are in its sensor's frame; the sensor looks from the origin.
    viewpoint = Vec3::Zero();
  }
  CloudFitOptions options;
  options.upright = !arguments.any_pose;
  Expected<CloudFruits> fitted = fit_cloud(file.cloud, options, viewpoint);
  if (!fitted) stop_with(kBadInput, {arguments.cloud + ": " + fitted.error().message});
  for (const auto* notices : {&file.notices, &fitted->notices}) {
    for (const std::string& notice : *notices) {
      std::fprintf(stderr, "canopeer: notice: %s\n", notice.c_str());
    }
  }
  keep_likely(*fitted, arguments.min_confidence);
  value_or_stop(write_all(arguments.out, *fitted), kFailed);
  std::printf("fruits            %zu in %zu points\n", fitted->fruits.size(),
              file.cloud.points.size());
  for (const FruitEstimate& f : fitted->fruits) {
    const bool told = f.ripeness != PixelLabel::background;
    std::printf("  %3d  at %.3f %.3f %.3f m  %.0f ± %.0f cm³  %.0f %% seen  confidence %.2f%s%s\n",
                f.id, f.centre.x(), f.centre.y(), f.centre.z(), f.volume_cm3, f.volume_sd_cm3,
                100.0 * f.seen_share, f.confidence, told ? "  " : "",
                told ? ripeness_name(f.ripeness) : "");
  }
  std::printf("results           %s\n", arguments.out.c_str());
}

}  // namespace canopeer::app
