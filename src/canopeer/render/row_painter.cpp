#include "canopeer/render/row_painter.h"

#include <algorithm>

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

}  // namespace

/// Neighbouring pixels of a row that show the same triangle.
struct PaintedRow::Run {
  Range pixels;
  const PaintedBody& body;
  std::uint32_t triangle;
  const CameraRays& camera;
  int v;
  SurfacePlane plane;

  [[nodiscard]] Vec3 direction(std::size_t u) const {
    const Vec3 ray = camera.ray(static_cast<int>(u), v);
    return body.rays.direction(ray.x(), ray.y());
  }
};

PaintedRow::PaintedRow(std::size_t width) {
  const std::size_t padded = (width + 15) / 16 * 16;
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

void PaintedRow::paint(std::span<const VisibleSurface> seen, const std::vector<PaintedBody>& bodies,
                       const CameraRays& rays, int v, std::int16_t* fruit, std::uint8_t* kind) {
  sky_.clear();
  structure_.clear();
  const bool pinhole = rays.lens().none();
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < seen.size(); begin = end) {
    end = begin + 1;
    while (end < seen.size() && seen[end] == seen[begin]) ++end;
    const Range pixels{begin, end};
    if (seen[begin].body == kNoSurface) {
      paint_sky(pixels);
      continue;
    }
    const PaintedBody& body = bodies[seen[begin].body];
    const std::uint32_t triangle = seen[begin].triangle;
    const Run run{pixels, body, triangle, rays,
                  v,      SurfacePlane(*body.soup, triangle, body.rays.eye)};
    if (pinhole) {
      paint_run(run);
    } else {
      for (std::size_t u = begin; u < end; ++u) paint_pixel(run, u);
    }
    paint_base(run);
    const SurfaceSoup::Part& part = body.soup->parts[body.soup->triangles[triangle].part];
    const int number = part.fruit >= 0 ? part.fruit + body.first_fruit : -1;
    std::fill(fruit + begin, fruit + end, static_cast<std::int16_t>(number));
    std::fill(kind + begin, kind + end, static_cast<std::uint8_t>(part.kind));
    if (part.kind == PartClass::structure) structure_.push_back(pixels);
  }
}

void PaintedRow::paint_sky(Range pixels) {
  for (std::size_t i = pixels.begin; i < pixels.end; ++i) {
    row_.normal_x[i] = row_.normal_y[i] = 0.0F;
    row_.normal_z[i] = row_.brightness[i] = row_.weight[i] = 1.0F;
    row_.depth[i] = 0.0F;
  }
  sky_.push_back(pixels);
}

/// All that is interpolated is a quotient of two linear functions of the column.
void PaintedRow::paint_run(const Run& run) {
  const Vec3 first = run.direction(run.pixels.begin);
  const Vec3 step = run.body.rays.right / run.camera.intrinsics().fx;
  const auto along = [&](const Vec3& d) {
    return Vec3(run.plane.edge[0].dot(d), run.plane.edge[1].dot(d), run.plane.edge[2].dot(d));
  };
  const Vec3 at_first = along(first);
  const double scale = 1.0 / at_first.sum();
  const Vec3 w = at_first * scale;
  const Vec3 dw = along(step) * scale;
  const double length = static_cast<double>(run.pixels.end - run.pixels.begin - 1);
  const Vec3 at_last = w + length * dw;
  const double least = std::min(w.minCoeff(), at_last.minCoeff() / at_last.sum());
  if (!(least >= -kOutside)) {
    for (std::size_t u = run.pixels.begin; u < run.pixels.end; ++u) paint_pixel(run, u);
    return;
  }
  const SurfaceSoup& soup = *run.body.soup;
  const auto& corners = soup.triangles[run.triangle].vertex;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal_step = Eigen::Vector3f::Zero();
  float brightness = 0.0F;
  float brightness_step = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const SurfaceSoup::Finish& f = soup.finish[corners[i]];
    const auto share = static_cast<float>(w[k]);
    const auto more = static_cast<float>(dw[k]);
    normal += share * f.normal;
    normal_step += more * f.normal;
    brightness += share * f.brightness;
    brightness_step += more * f.brightness;
  }
  normal = run.body.R_world_body * normal;
  normal_step = run.body.R_world_body * normal_step;
  const auto depth = static_cast<float>(run.plane.corner[0].dot(run.plane.edge[0]) * scale);
  const auto weight_step = static_cast<float>(dw.sum());
  for (std::size_t i = run.pixels.begin; i < run.pixels.end; ++i) {
    const auto k = static_cast<float>(i - run.pixels.begin);
    row_.normal_x[i] = normal.x() + k * normal_step.x();
    row_.normal_y[i] = normal.y() + k * normal_step.y();
    row_.normal_z[i] = normal.z() + k * normal_step.z();
    row_.brightness[i] = brightness + k * brightness_step;
    row_.depth[i] = depth;
    row_.weight[i] = 1.0F + k * weight_step;
  }
}

void PaintedRow::paint_pixel(const Run& run, std::size_t u) {
  const Vec3 w = run.plane.weights_inside(run.direction(u));
  const SurfaceSoup& soup = *run.body.soup;
  const auto& corners = soup.triangles[run.triangle].vertex;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Vec3 point = Vec3::Zero();
  row_.brightness[u] = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const SurfaceSoup::Finish& f = soup.finish[corners[i]];
    normal += static_cast<float>(w[k]) * f.normal;
    row_.brightness[u] += static_cast<float>(w[k]) * f.brightness;
    point += w[k] * run.plane.corner[i];
  }
  normal = run.body.R_world_body * normal;
  row_.normal_x[u] = normal.x();
  row_.normal_y[u] = normal.y();
  row_.normal_z[u] = normal.z();
  row_.depth[u] = static_cast<float>(run.body.rays.ahead.dot(point));
  row_.weight[u] = 1.0F;
}

void PaintedRow::paint_base(const Run& run) {
  const SurfaceSoup& soup = *run.body.soup;
  const SurfaceSoup::Part& part = soup.parts[soup.triangles[run.triangle].part];
  const Finish finish = finish_of(part.kind);
  const bool plain = part.texture == nullptr && !part.vertex_colors;
  Eigen::Vector3f base = run.body.brightness * part.color;
  const float wide = run.body.brightness * finish.gloss_wide;
  const float narrow = run.body.brightness * finish.gloss_narrow;
  for (std::size_t i = run.pixels.begin; i < run.pixels.end; ++i) {
    if (!plain) {
      const Vec3 w = run.plane.weights_inside(run.direction(i));
      base = run.body.brightness *
             base_color(soup, run.triangle,
                        {static_cast<float>(w.y()), static_cast<float>(w.z())});
    }
    row_.red[i] = base.x();
    row_.green[i] = base.y();
    row_.blue[i] = base.z();
    row_.gloss_wide[i] = wide;
    row_.gloss_narrow[i] = narrow;
    row_.through[i] = finish.through;
  }
}

}  // namespace canopeer
