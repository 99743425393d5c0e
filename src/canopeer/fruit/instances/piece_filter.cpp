#include "canopeer/fruit/instances/piece_filter.h"

#include <Eigen/Eigenvalues>
#include <limits>
#include <map>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

/// Lengths along the principal axes, the longest first.
Vec3 principal_extents(std::span<const SurfacePoint> surface, const std::vector<int>& members) {
  Vec3 mean = Vec3::Zero();
  for (const int i : members) mean += surface[i].point;
  mean /= static_cast<double>(members.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const int i : members) {
    const Vec3 d = surface[i].point - mean;
    spread += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const int i : members) {
    const Vec3 p = axes.eigenvectors().transpose() * (surface[i].point - mean);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).reverse();  // eigenvalues come in ascending order
}

bool odd(std::span<const SurfacePoint> surface, const std::vector<int>& members,
         const FruitMapOptions& options) {
  if (static_cast<int>(members.size()) < options.min_cluster_points) return true;
  const Vec3 extents = principal_extents(surface, members);
  return extents[0] > options.max_piece_m && extents[1] < 2.0 * options.prior.radius_m;
}

}  // namespace

std::vector<char> ordinary_pieces(std::span<const SurfacePoint> surface, std::span<const int> piece,
                                  const FruitMapOptions& options) {
  CANOPEER_CHECK(surface.size() == piece.size(), "one piece number per point");
  std::map<int, std::vector<int>> members;
  for (std::size_t i = 0; i < piece.size(); ++i) members[piece[i]].push_back(static_cast<int>(i));
  std::vector<char> keep(surface.size(), 1);
  for (const auto& [number, points] : members) {
    if (!odd(surface, points, options)) continue;
    for (const int i : points) keep[i] = 0;
  }
  return keep;
}

}  // namespace canopeer
