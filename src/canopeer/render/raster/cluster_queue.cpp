#include "canopeer/render/raster/cluster_queue.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace canopeer {
namespace {

constexpr float kRounding = 1e-5F;  // share of a distance that single precision may be off by
constexpr float kNear = 0.01F;      // nearer boxes are not held against the picture, m
constexpr float kPixels = 0.05F;    // to spare around a box

/// A box along the camera's axes around a box along the body's, rounding included. x and y in
/// pixels times depth.
struct SeenBox {
  Eigen::Vector3f low, high;
};

SeenBox seen_box(const BodyView& view, const Eigen::Vector3f& centre, const Eigen::Vector3f& half) {
  const Eigen::Vector3f off = centre - view.eye;
  const Eigen::Vector3f middle = view.turn * off + view.shift;
  const Eigen::Matrix3f reach = view.turn.cwiseAbs();
  const Eigen::Vector3f around = reach * (half + kRounding * (off.cwiseAbs() + half));
  return {middle - around, middle + around};
}

/// Lines from the camera through the picture's borders, pixels off the principal point.
struct Borders {
  Borders(const CameraIntrinsics& camera, float far_m)
      : far(far_m),
        left(static_cast<float>(-camera.cx)),
        right(static_cast<float>(camera.width - camera.cx)),
        top(static_cast<float>(-camera.cy)),
        bottom(static_cast<float>(camera.height - camera.cy)) {}

  [[nodiscard]] bool outside(const SeenBox& box) const {
    if (!(box.high.z() > 0.0F) || box.low.z() > far) return true;
    const auto most = [&](float slope) {
      return std::max(slope * box.low.z(), slope * box.high.z());
    };
    return box.high.x() + most(-left) < 0.0F || most(right) - box.low.x() < 0.0F ||
           box.high.y() + most(-top) < 0.0F || most(bottom) - box.low.y() < 0.0F;
  }

  float far;
  float left, right, top, bottom;
};

/// Pixels between two slopes off the principal point, held inside 0 … last; first > last: none.
std::pair<int, int> pixels_between(float low, float high, double centre, int last) {
  const auto c = static_cast<float>(centre - 0.5);
  const auto end = static_cast<float>(last);
  return {static_cast<int>(std::clamp(std::ceil(low + c - kPixels), 0.0F, end + 1.0F)),
          static_cast<int>(std::clamp(std::floor(high + c + kPixels), -1.0F, end))};
}

float slope_low(float x, float near, float far) { return x < 0.0F ? x / near : x / far; }
float slope_high(float x, float near, float far) { return x < 0.0F ? x / far : x / near; }

/// Its pixels and how near it is at most; none: it is between two pixel centres or outside.
std::optional<QueuedCluster> place(const SeenBox& box, const CameraIntrinsics& camera) {
  QueuedCluster placed;
  const float near = box.low.z();
  const float far = box.high.z();
  if (near <= kNear) {
    placed.box = {0, camera.width - 1, 0, camera.height - 1};
    placed.nearness = std::numeric_limits<float>::infinity();
    return placed;
  }
  const auto [u0, u1] =
      pixels_between(slope_low(box.low.x(), near, far), slope_high(box.high.x(), near, far),
                     camera.cx, camera.width - 1);
  const auto [v0, v1] =
      pixels_between(slope_low(box.low.y(), near, far), slope_high(box.high.y(), near, far),
                     camera.cy, camera.height - 1);
  if (u0 > u1 || v0 > v1) return std::nullopt;
  placed.box = {u0, u1, v0, v1};
  placed.nearness = (1.0F + kRounding) / near;
  return placed;
}

}  // namespace

BodyView body_view(const RasterBody& body, const CameraIntrinsics& camera,
                   const Pose& T_world_camera) {
  const Pose T_body_camera = body.T_world_body.inverse(Eigen::Isometry) * T_world_camera;
  Eigen::Matrix3d turn = T_body_camera.linear().transpose();
  turn.row(0) *= camera.fx;
  turn.row(1) *= camera.fy;
  const Vec3 eye = T_body_camera.translation();
  const Eigen::Vector3f rounded = eye.cast<float>();
  return {turn.cast<float>(), rounded, (turn * (rounded.cast<double>() - eye)).cast<float>()};
}

std::vector<QueuedCluster> queue_clusters(const std::vector<RasterBody>& bodies,
                                          const std::vector<BodyView>& views,
                                          const CameraIntrinsics& camera, float far_m) {
  const Borders borders(camera, far_m);
  std::vector<QueuedCluster> found;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const TriangleClusters& all = *bodies[b].clusters;
    if (all.clusters.empty()) continue;
    const Eigen::Vector3f centre = all.bounds.center().cast<float>();
    const Eigen::Vector3f half = (0.5 * all.bounds.sizes()).cast<float>();
    if (borders.outside(seen_box(views[b], centre, half))) continue;
    for (std::size_t c = 0; c < all.clusters.size(); ++c) {
      const SeenBox box = seen_box(views[b], all.clusters[c].centre, all.clusters[c].half);
      if (borders.outside(box)) continue;
      if (auto placed = place(box, camera)) {
        placed->body = static_cast<std::uint32_t>(b);
        placed->cluster = static_cast<std::uint32_t>(c);
        found.push_back(*placed);
      }
    }
  }
  // Positive numbers sort as their bits do; equally near ones stay in order.
  std::vector<std::uint64_t> order(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    order[i] = (std::uint64_t{~std::bit_cast<std::uint32_t>(found[i].nearness)} << 32) | i;
  }
  std::sort(order.begin(), order.end());
  std::vector<QueuedCluster> queue;
  queue.reserve(found.size());
  for (const std::uint64_t key : order) queue.push_back(found[key & 0xffffffffU]);
  return queue;
}

}  // namespace canopeer
