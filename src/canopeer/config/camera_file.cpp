#include "canopeer/config/camera_file.h"

#include <cmath>

#include "canopeer/config/yaml_reader.h"

namespace canopeer {

CameraIntrinsics intrinsics_of(double fx_px, double fy_px, double cx_px, double cy_px) {
  CameraIntrinsics k;
  k.width = 0;
  k.height = 0;
  k.fx = fx_px;
  k.fy = fy_px;
  k.cx = cx_px + 0.5;  // ours has pixel centres at halves
  k.cy = cy_px + 0.5;
  return k;
}

Expected<CameraFile> load_camera(const std::filesystem::path& path) {
  auto yaml = YamlMap::load(path);
  if (!yaml) return tl::unexpected(yaml.error());
  constexpr double kMaxPixels = 100000.0;
  const double fx = yaml->required_number("fx_px", {1.0, kMaxPixels});
  const double fy = yaml->required_number("fy_px", {-kMaxPixels, kMaxPixels});
  const double cx = yaml->required_number("cx_px", {-kMaxPixels, kMaxPixels});
  const double cy = yaml->required_number("cy_px", {-kMaxPixels, kMaxPixels});
  if (yaml->has("fy_px") && std::abs(fy) < 1.0)
    yaml->complain("fy_px", "expected at least one pixel");
  CameraFile file;
  file.intrinsics = intrinsics_of(fx, std::abs(fy), cx, cy);
  file.y_up = fy < 0.0;
  file.intrinsics.width = yaml->integer("width_px", 0, 0, 100000);
  file.intrinsics.height = yaml->integer("height_px", 0, 0, 100000);
  file.depth.per_m = yaml->number("depth_units_per_m", 5000.0, {1e-3, 1e9});
  file.depth.max_depth_m = yaml->number("max_depth_m", 0.0, {0.0, 1e6});
  if (auto done = yaml->finish(); !done) return tl::unexpected(done.error());
  return file;
}

}  // namespace canopeer
