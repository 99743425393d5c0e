#include "canopeer/render/shading/row_painter.h"

#include <algorithm>

#include "canopeer/render/raster/lanes.h"

namespace canopeer {
namespace {

/// How a material answers light.
struct Finish {
  float gloss_wide = 0.0F;    // highlight with exponent 8, grey levels
  float gloss_narrow = 0.0F;  // with exponent 32
  float through = 0.0F;       // share of light from behind that comes through
};

Finish finish_of(PartClass kind) {
  switch (kind) {
    case PartClass::leaf:
      return {14.0F, 0.0F, 0.45F};
    case PartClass::fruit:
      return {0.0F, 110.0F, 0.0F};
    case PartClass::stem:
    case PartClass::calyx:
      return {8.0F, 0.0F, 0.0F};
    default:
      return {};
  }
}

/// Beyond this the weights of a ray that grazes a triangle or passes it by a rounding are held to
/// the triangle itself.
constexpr double kOutside = 1e-3;
constexpr std::size_t kKept = 1024;  // triangles
constexpr std::size_t kPadding = 16;

std::size_t slot_of(VisibleSurface surface) {
  return (surface.triangle ^ (surface.body * 0x9e3779b1U >> 16)) % kKept;
}

}  // namespace

/// A triangle as the pixels of this view meet it.
struct RowPainter::Triangle {
  /// Side of edge i at pixel (u, v): along_u[i] · u + along_v[i] · v + at_zero[i]; the sides over
  /// their sum are the weights of the corners.
  Vec3 along_u, along_v, at_zero;
  double volume = 0.0;         // over the sum of the sides it is the depth
  Eigen::Vector3f depth;       // of the corners
  Eigen::Matrix3f normals;     // of the corners, world, one a column
  Eigen::Vector3f brightness;  // of the corners
  Eigen::Vector3f base;        // colour
  Finish finish;
  const PaintedBody* body = nullptr;
  std::uint32_t number = 0;  // in the body's soup
  bool plain = true;         // one colour
  std::int16_t fruit = -1;
  PartClass kind = PartClass::structure;

  [[nodiscard]] Vec3 sides(double u, double v) const {
    return along_u * u + (along_v * v + at_zero);
  }
};

/// What a few pixels have in common, and how it changes from each to the next.
struct RowPainter::Shades {
  Eigen::Vector3f normal, normal_step;
  float brightness = 0.0F, brightness_step = 0.0F;
  float weight_step = 0.0F;
  float depth = 0.0F;
  Eigen::Vector3f base;
  Finish finish;
};

RowPainter::RowPainter(const std::vector<PaintedBody>& bodies, const CameraRays& rays)
    : bodies_(bodies), rays_(rays), triangles_(kKept), kept_(kKept) {
  const auto width = static_cast<std::size_t>(rays.intrinsics().width);
  const std::size_t padded = (width + kPadding - 1) / kPadding * kPadding + kPadding;
  memory_.assign(kShadedRowArrays * padded, 0.0F);
  row_.count = width;
  float* next = memory_.data();
  for (float** array :
       {&row_.ray_x, &row_.ray_y, &row_.ray_z, &row_.normal_x, &row_.normal_y, &row_.normal_z,
        &row_.brightness, &row_.depth, &row_.weight, &row_.red, &row_.green, &row_.blue,
        &row_.gloss_wide, &row_.gloss_narrow, &row_.through, &row_.lit}) {
    *array = next;
    next += padded;
  }
  std::fill_n(row_.weight, padded, 1.0F);
  std::fill_n(row_.lit, padded, 1.0F);
}

RowPainter::~RowPainter() = default;

const RowPainter::Triangle& RowPainter::prepared(VisibleSurface surface) {
  const std::size_t slot = slot_of(surface);
  Triangle& t = triangles_[slot];
  if (kept_[slot] == surface) return t;
  kept_[slot] = surface;
  t.body = &bodies_[surface.body];
  t.number = surface.triangle;
  const SurfaceSoup& soup = *t.body->soup;
  const BodyRays& rays = t.body->rays;
  const CameraIntrinsics& camera = rays_.intrinsics();
  const SurfacePlane plane(soup, surface.triangle, rays.eye);
  const Vec3 origin = rays.direction((0.5 - camera.cx) / camera.fx, (0.5 - camera.cy) / camera.fy);
  const SurfaceSoup::Triangle& corners = soup.triangles[surface.triangle];
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    t.along_u[i] = plane.edge[k].dot(rays.right) / camera.fx;
    t.along_v[i] = plane.edge[k].dot(rays.down) / camera.fy;
    t.at_zero[i] = plane.edge[k].dot(origin);
    t.depth[i] = static_cast<float>(rays.ahead.dot(plane.corner[k]));
    const SurfaceSoup::Finish& finish = soup.finish[corners.vertex[k]];
    t.normals.col(i) = t.body->R_world_body * finish.normal;
    t.brightness[i] = finish.brightness;
  }
  t.volume = plane.corner[0].dot(plane.edge[0]);
  const SurfaceSoup::Part& part = soup.parts[corners.part];
  t.kind = part.kind;
  t.fruit = static_cast<std::int16_t>(part.fruit >= 0 ? part.fruit + t.body->first_fruit : -1);
  t.plain = part.texture == nullptr && !part.vertex_colors;
  t.base = t.body->brightness * part.color;
  t.finish = finish_of(part.kind);
  t.finish.gloss_wide *= t.body->brightness;
  t.finish.gloss_narrow *= t.body->brightness;
  return t;
}

void RowPainter::paint(std::span<const VisibleRun> runs, int v, std::int16_t* fruit,
                       std::uint8_t* kind) {
  sky_.clear();
  structure_.clear();
  const bool pinhole = rays_.lens().none();
  for (const VisibleRun& run : runs) {
    const Range pixels{run.begin, run.end};
    if (run.surface.body == kNoSurface) {
      paint_sky(pixels);
      continue;
    }
    const Triangle& triangle = prepared(run.surface);
    if (pinhole && triangle.plain) {
      paint_run(triangle, pixels, v);
    } else {
      const CameraIntrinsics& camera = rays_.intrinsics();
      for (std::size_t u = pixels.begin; u < pixels.end; ++u) {
        const Vec3 ray = rays_.ray(static_cast<int>(u), v);
        paint_pixel(triangle, u,
                    triangle.sides(ray.x() * camera.fx + camera.cx - 0.5,
                                   ray.y() * camera.fy + camera.cy - 0.5));
      }
    }
    for (std::size_t u = pixels.begin; u < pixels.end; ++u) {
      fruit[u] = triangle.fruit;
      kind[u] = static_cast<std::uint8_t>(triangle.kind);
    }
    if (triangle.kind == PartClass::structure) structure_.push_back(pixels);
  }
}

void RowPainter::paint_sky(Range pixels) {
  Shades shades;
  shades.normal = Eigen::Vector3f::UnitZ();
  shades.normal_step = shades.base = Eigen::Vector3f::Zero();
  fill(shades, pixels);
  sky_.push_back(pixels);
}

/// All that is interpolated is a quotient of two linear functions of the column.
void RowPainter::paint_run(const Triangle& t, Range pixels, int v) {
  const Vec3 first = t.sides(static_cast<double>(pixels.begin), v);
  const double scale = 1.0 / first.sum();
  const Vec3 weights = first * scale;
  const Vec3 steps = t.along_u * scale;
  const Vec3 last = weights + static_cast<double>(pixels.end - pixels.begin - 1) * steps;
  if (!(std::min(weights.minCoeff(), last.minCoeff()) >= -kOutside)) {
    for (std::size_t u = pixels.begin; u < pixels.end; ++u) {
      paint_pixel(t, u, t.sides(static_cast<double>(u), v));
    }
    return;
  }
  const Eigen::Vector3f w = weights.cast<float>();
  const Eigen::Vector3f dw = steps.cast<float>();
  Shades shades;
  shades.normal = t.normals * w;
  shades.normal_step = t.normals * dw;
  shades.brightness = t.brightness.dot(w);
  shades.brightness_step = t.brightness.dot(dw);
  shades.weight_step = static_cast<float>(steps.sum());
  shades.depth = static_cast<float>(t.volume * scale);
  shades.base = t.base;
  shades.finish = t.finish;
  fill(shades, pixels);
}

/// A pixel by itself, held to the triangle: at its rim, behind a lens, of many colours.
void RowPainter::paint_pixel(const Triangle& t, std::size_t u, const Vec3& sides) {
  Vec3 weights = (sides / sides.sum()).cwiseMax(0.0);
  weights = weights.allFinite() ? Vec3(weights / weights.sum()) : Vec3::Constant(1.0 / 3.0);
  const Eigen::Vector3f w = weights.cast<float>();
  Shades shades;
  shades.normal = t.normals * w;
  shades.normal_step = Eigen::Vector3f::Zero();
  shades.brightness = t.brightness.dot(w);
  shades.depth = t.depth.dot(w);
  shades.base = t.plain ? t.base
                        : Eigen::Vector3f(t.body->brightness *
                                          base_color(*t.body->soup, t.number, {w.y(), w.z()}));
  shades.finish = t.finish;
  fill(shades, {u, u + 1});
}

/// Whole vectors are written: what they overlap is painted after.
void RowPainter::fill(const Shades& s, Range pixels) {
  Floats k;
  for (int i = 0; i < kLanes; ++i) k[i] = static_cast<float>(i);
  for (std::size_t i = pixels.begin; i < pixels.end; i += kLanes, k += static_cast<float>(kLanes)) {
    store(s.normal.x() + k * s.normal_step.x(), row_.normal_x + i);
    store(s.normal.y() + k * s.normal_step.y(), row_.normal_y + i);
    store(s.normal.z() + k * s.normal_step.z(), row_.normal_z + i);
    store(s.brightness + k * s.brightness_step, row_.brightness + i);
    store(1.0F + k * s.weight_step, row_.weight + i);
    store(all(s.depth), row_.depth + i);
    store(all(s.base.x()), row_.red + i);
    store(all(s.base.y()), row_.green + i);
    store(all(s.base.z()), row_.blue + i);
    store(all(s.finish.gloss_wide), row_.gloss_wide + i);
    store(all(s.finish.gloss_narrow), row_.gloss_narrow + i);
    store(all(s.finish.through), row_.through + i);
  }
}

}  // namespace canopeer
