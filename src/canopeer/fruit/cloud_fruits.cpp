#include "canopeer/fruit/cloud_fruits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "canopeer/fruit/color_ripeness.h"
#include "canopeer/fruit/confidence/plausibility.h"
#include "canopeer/fruit/instances/euclidean_clusters.h"
#include "canopeer/fruit/instances/fruit_separation.h"
#include "canopeer/fruit/instances/piece_filter.h"
#include "canopeer/fruit/missing_surface.h"
#include "canopeer/fruit/surface/cloud_normals.h"

namespace canopeer {
namespace {

constexpr double kGroup_m = 0.05;        // points farther apart are never of one fruit
constexpr double kMaxSpacing_m = 0.015;  // of points that show a surface
constexpr double kMinExtent_m = 0.02;
constexpr double kFarthest_m = 2000.0;  // voxel indices reach to ± 2²⁰ cells
constexpr double kMaxFarShare = 0.1;    // more far points are no mistakes of a sensor
constexpr double kNowhere_m = 1e8;      // beyond, whatever the unit

/// Points that somebody measured, which of the cloud each is, and what else there was.
struct MeasuredPoints {
  std::vector<Vec3> points;
  std::vector<std::size_t> index;
  std::size_t not_finite = 0, nowhere = 0, far = 0, at_origin = 0;
};

/// Writers have many words for "no point": NaN, 1e30, several points at 0 0 0.
MeasuredPoints measured_points(const PointCloud& cloud) {
  MeasuredPoints measured;
  const auto is_zero = [](const Eigen::Vector3f& p) { return p.isZero(0.0F); };
  const bool zeros = std::count_if(cloud.points.begin(), cloud.points.end(), is_zero) > 1;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    if (!p.allFinite()) {
      ++measured.not_finite;
    } else if (p.cwiseAbs().maxCoeff() > kFarthest_m) {
      ++(p.cwiseAbs().maxCoeff() > kNowhere_m ? measured.nowhere : measured.far);
    } else if (zeros && is_zero(p)) {
      ++measured.at_origin;
    } else {
      measured.points.push_back(p.cast<double>());
      measured.index.push_back(i);
    }
  }
  return measured;
}

std::vector<std::string> notices_of(const MeasuredPoints& measured) {
  std::vector<std::string> notices;
  const auto note = [&](std::size_t count, const std::string& what) {
    if (count > 0) notices.push_back(fmt::format("left out: {} {}", count, what));
  };
  note(measured.not_finite, "points that are not finite");
  note(measured.nowhere + measured.far, fmt::format("points beyond {:.0f} m", kFarthest_m));
  note(measured.at_origin, "points at 0 0 0");
  return notices;
}

Expected<void> check_scale(const MeasuredPoints& measured, std::size_t all, int min_points) {
  const std::vector<Vec3>& points = measured.points;
  if (all == 0) return fail("the cloud is empty");
  if (measured.not_finite == all) return fail(fmt::format("none of the {} points is finite", all));
  if (static_cast<double>(measured.far) > kMaxFarShare * static_cast<double>(points.size())) {
    return fail(
        fmt::format("coordinates of {} points beyond {:.0f} m: are they in metres, about a nearby "
                    "origin? (see --unit)",
                    measured.far, kFarthest_m));
  }
  if (static_cast<int>(points.size()) < min_points) {
    std::string usable = fmt::format("only {} finite points", points.size());
    if (const std::size_t strays = measured.nowhere + measured.far + measured.at_origin) {
      usable = fmt::format("only {} of {} finite points are neither at 0 0 0 nor beyond {:.0f} m",
                           points.size(), points.size() + strays, kFarthest_m);
    }
    return fail(fmt::format("{}; a fruit needs {}", usable, min_points));
  }
  Box bounds;
  for (const Vec3& p : points) bounds.extend(p);
  const double extent = bounds.sizes().maxCoeff();
  if (extent < kMinExtent_m) {
    return fail(
        fmt::format("the whole cloud is {:.3g} m wide, less than a fruit: are the "
                    "coordinates in metres? (see --unit)",
                    extent));
  }
  return {};
}

/// Means over each cell of what the cloud knows of its points.
struct Thinned {
  std::vector<SurfacePoint> surface;
  std::vector<Rgb> colors;
};

Thinned thin(const PointCloud& cloud, const std::vector<Vec3>& points,
             const std::vector<std::size_t>& index, const CloudFitOptions& options,
             const std::optional<Vec3>& viewpoint) {
  std::vector<int> place;
  const std::vector<Vec3> centres = thin_to_grid(points, options.cell_m, place);
  std::vector<Vec3> normals(centres.size(), Vec3::Zero());
  std::vector<std::array<double, 4>> colors(centres.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t cell = static_cast<std::size_t>(place[i]);
    if (!cloud.normals.empty() && cloud.normals[index[i]].allFinite()) {
      normals[cell] += cloud.normals[index[i]].cast<double>();
    }
    if (cloud.colors.empty()) continue;
    const Rgb& c = cloud.colors[index[i]];
    colors[cell][0] += c.r;
    colors[cell][1] += c.g;
    colors[cell][2] += c.b;
    colors[cell][3] += 1.0;
  }
  std::vector<Vec3> estimated;
  Thinned thinned;
  for (std::size_t k = 0; k < centres.size(); ++k) {
    Vec3 n = normals[k];
    if (!(n.norm() > 1e-3)) {
      if (estimated.empty()) {
        estimated = estimate_normals(centres, options.normal_radius_m, viewpoint);
      }
      n = estimated[k];
    }
    if (!n.allFinite()) continue;  // too lonely to be a surface
    thinned.surface.push_back({centres[k], n.normalized()});
    if (cloud.colors.empty()) continue;
    const auto channel = [&](std::size_t c) {
      return static_cast<std::uint8_t>(std::lround(colors[k][c] / colors[k][3]));
    };
    thinned.colors.push_back({channel(0), channel(1), channel(2)});
  }
  return thinned;
}

/// Points of each group that is far from all others, without specks and long things.
std::vector<std::vector<int>> groups_of(const std::vector<SurfacePoint>& surface,
                                        const FruitMapOptions& options) {
  const std::vector<int> piece = euclidean_clusters(surface, options.cluster_tolerance_m);
  const std::vector<char> keep = ordinary_pieces(surface, piece, options);
  const std::vector<int> group = euclidean_clusters(surface, kGroup_m);
  std::vector<std::vector<int>> groups;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (group[i] >= static_cast<int>(groups.size())) groups.resize(group[i] + 1);
    if (keep[i] != 0) groups[group[i]].push_back(static_cast<int>(i));
  }
  return groups;
}

Rgb mean_color(const std::vector<Rgb>& colors) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (const Rgb& c : colors) sum += Eigen::Array3d(c.r, c.g, c.b);
  sum = sum / static_cast<double>(colors.size()) + 0.5;
  return {static_cast<std::uint8_t>(sum[0]), static_cast<std::uint8_t>(sum[1]),
          static_cast<std::uint8_t>(sum[2])};
}

}  // namespace

Expected<CloudFruits> fit_cloud(const PointCloud& cloud, const CloudFitOptions& options,
                                const std::optional<Vec3>& viewpoint) {
  FruitMapOptions limits = options.fruit;
  limits.min_height_m = -1e9;  // whoever has a cloud of fruits knows best
  if (auto ok = limits.validate(); !ok) return tl::unexpected(ok.error());
  const MeasuredPoints measured = measured_points(cloud);
  const std::vector<Vec3>& points = measured.points;
  if (auto ok = check_scale(measured, cloud.points.size(), limits.min_points); !ok) {
    return tl::unexpected(ok.error());
  }
  const double spacing = median_spacing(points);
  if (spacing > kMaxSpacing_m) {
    return fail(
        fmt::format("neighbouring points are {:.3g} m apart: are the coordinates in metres? "
                    "(see --unit; a surface needs points at most {} m apart)",
                    spacing, kMaxSpacing_m));
  }
  const Thinned thinned = thin(cloud, points, measured.index, options, viewpoint);
  FitOptions fit_options;
  fit_options.prior = limits.prior;
  fit_options.max_points = options.fit_points;
  if (!options.upright) fit_options.prior.tilt_sd_rad = 10.0;
  CloudFruits result;
  result.notices = notices_of(measured);
  for (const SurfacePoint& s : thinned.surface) {
    result.surface.points.push_back(s.point.cast<float>());
    result.surface.normals.push_back(s.normal.cast<float>());
  }
  result.surface.colors = thinned.colors;
  result.fruit.assign(thinned.surface.size(), -1);
  for (const std::vector<int>& group : groups_of(thinned.surface, limits)) {
    std::vector<SurfacePoint> surface;
    for (const int i : group) surface.push_back(thinned.surface[i]);
    for (const SeparatedFruit& separated : separate_fruits(surface, limits)) {
      std::vector<SurfacePoint> own;
      std::vector<int> own_index;
      for (const int k : separated.points) {
        own.push_back(surface[k]);
        own_index.push_back(group[k]);
      }
      const SuperellipsoidFit fit = fit_superellipsoid(own, fit_options);
      const MissingSurface missing = missing_surface(fit.body, own);
      FruitEstimate e;
      set_shape(fit, e);
      e.seen_share = missing.seen_share();
      e.points = static_cast<int>(own.size());
      e.views = 1;
      e.id = static_cast<int>(result.fruits.size());
      if (!thinned.colors.empty()) {
        std::vector<Rgb> colors;
        for (const int i : own_index) colors.push_back(thinned.colors[i]);
        e.color = mean_color(colors);
        e.ripeness = ripeness_of_surface(colors);
      }
      SurfaceEvidence seen;
      seen.normal_spread = normal_spread(surface, separated.points);
      e.confidence =
          limits.confidence(evidence_of(e, limits, 1e4 * options.cell_m * options.cell_m, seen));
      std::vector<Vec3>& unseen = result.missing.emplace_back();
      for (const SurfacePoint& s : missing.points) unseen.push_back(s.point);
      for (const int i : own_index) result.fruit[i] = e.id;
      result.fruits.push_back(e);
    }
  }
  return result;
}

}  // namespace canopeer
