#include "canopeer/render/overview.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "canopeer/base/check.h"
#include "canopeer/render/renderer.h"

namespace canopeer {
namespace {

constexpr int kSamples = 2;  // a side and pixel
constexpr double kFovY = 26.0 * std::numbers::pi / 180.0;
constexpr double kFill = 0.94;  // of the picture by the plants
constexpr std::size_t kEnoughPoints = 20000;

/// Points all over the plants, or over everything when there are none: far fewer than there are.
std::vector<Vec3> points_on(const Scene& scene) {
  const bool any_plant = scene.plant_count() > 0;
  std::size_t total = 0;
  scene.for_each_part([&](const ScenePart& part, const Pose&, const SceneInstance*) {
    total += part.mesh.vertices.size();
  });
  const std::size_t step = 1 + total / kEnoughPoints;
  std::vector<Vec3> points;
  std::size_t at = 0;
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance*) {
    if (any_plant && part.plant < 0) return;
    for (const auto& v : part.mesh.vertices) {
      if (at++ % step == 0) points.push_back(T * v.cast<double>());
    }
  });
  return points;
}

/// How far the points reach in the picture: −1 … 1 is inside it.
Eigen::AlignedBox2d projected(const std::vector<Vec3>& points, const Pose& T_world_camera,
                              const CameraIntrinsics& camera) {
  const Pose T_camera_world = T_world_camera.inverse(Eigen::Isometry);
  Eigen::AlignedBox2d reach;
  for (const Vec3& point : points) {
    const Vec3 p = T_camera_world * point;
    const double depth = std::max(p.z(), 1e-3);
    reach.extend(Eigen::Vector2d(p.x() / depth * 2.0 * camera.fx / camera.width,
                                 p.y() / depth * 2.0 * camera.fy / camera.height));
  }
  return reach;
}

/// Sees both rows slantwise from above one end of the aisle. Aim and distance are corrected in turn
/// until the plants are in the middle and just fill the picture.
Pose choose_camera(const Box& plants, const std::vector<Vec3>& points,
                   const CameraIntrinsics& camera) {
  const Vec3 away = Vec3(0.62, -0.68, 0.40).normalized();
  Vec3 aim = plants.center();
  double distance = plants.diagonal().norm();
  for (int i = 0; i < 40; ++i) {
    const Pose pose = look_at(aim + distance * away, aim);
    const Eigen::AlignedBox2d reach = projected(points, pose, camera);
    const Eigen::Vector2d off = reach.center();
    aim += 0.5 * distance *
           (off.x() * 0.5 * camera.width / camera.fx * pose.linear().col(0) +
            off.y() * 0.5 * camera.height / camera.fy * pose.linear().col(1));
    distance *= std::clamp(0.5 * reach.sizes().maxCoeff() / kFill, 0.8, 1.25);
  }
  return look_at(aim + distance * away, aim);
}

/// The scene without the walls and the roof that are in the camera's way.
Scene open_scene(const Scene& scene, const Box& plants, const Vec3& eye) {
  Scene open = scene;
  std::erase_if(open.parts, [&](const ScenePart& part) {
    if (!part.static_structure()) return false;
    const Box box = part.mesh.bounds();
    const bool between_x = eye.x() > plants.max().x() && box.min().x() > plants.max().x();
    const bool upright = box.max().z() > 1.0;
    const bool roof = box.min().z() > plants.max().z();
    return roof || (upright && between_x);
  });
  return open;
}

ColorImage halve(const ColorImage& fine) {
  ColorImage image(fine.width() / kSamples, fine.height() / kSamples);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      int r = 0;
      int g = 0;
      int b = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const Rgb& c = fine.at(u * kSamples + k % kSamples, v * kSamples + k / kSamples);
        r += c.r;
        g += c.g;
        b += c.b;
      }
      const auto mean = [](int sum) {
        return static_cast<std::uint8_t>((sum + 2) / (kSamples * kSamples));
      };
      image.at(u, v) = {mean(r), mean(g), mean(b)};
    }
  }
  return image;
}

}  // namespace

ColorImage render_overview(const Scene& scene, int width, int height) {
  CANOPEER_CHECK(width > 0 && height > 0, "an image has pixels");
  Box plants = scene.bounds(true);
  if (plants.isEmpty()) plants = scene.bounds();
  CANOPEER_CHECK(!plants.isEmpty(), "an overview needs something to show");
  const double fov_x = 2.0 * std::atan(std::tan(0.5 * kFovY) * static_cast<double>(width) / height);
  const auto camera = CameraIntrinsics::from_fov(width * kSamples, height * kSamples, fov_x);
  const Pose T_world_camera = choose_camera(plants, points_on(scene), camera);
  RenderOptions options;
  options.shadows = true;
  options.color_noise = 0.0;
  const Renderer renderer(open_scene(scene, plants, T_world_camera.translation()), options);
  return halve(renderer.render(camera, T_world_camera).color);
}

}  // namespace canopeer
