#include "canopeer/import/assembly/convex_hull.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <numeric>

namespace canopeer {
namespace {

/// Qhull's state, freed whatever happens; what it prints goes nowhere.
class Qhull {
 public:
  Qhull() : silence_(std::fopen("/dev/null", "w")) { qh_zero(&state_, silence_); }
  ~Qhull() {
    state_.NOerrexit = True;
    qh_freeqhull(&state_, !qh_ALL);
    int unfreed = 0;
    int total = 0;
    qh_memfreeshort(&state_, &unfreed, &total);
    if (silence_ != nullptr) std::fclose(silence_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  /// Triangulated facets (Qt); false when the points are flat.
  bool build(std::vector<double>* coordinates) {
    char command[] = "qhull Qt";
    return silence_ != nullptr &&
           qh_new_qhull(&state_, 3, static_cast<int>(coordinates->size() / 3), coordinates->data(),
                        False, command, nullptr, silence_) == 0;
  }
  qhT* state() { return &state_; }

 private:
  std::FILE* silence_;
  qhT state_{};
};

Vec3 to_vec3(const coordT* p) { return {p[0], p[1], p[2]}; }

/// Sums over the tetrahedra from `origin` to each facet: volume, first and second moments.
struct Moments {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double v = a.dot(b.cross(c)) / 6.0;
    const Vec3 sum = a + b + c;
    volume += v;
    first += v / 4.0 * sum;
    second += v / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
};

void add_facet(facetT* facet, qhT* qh, const Vec3& origin, Moments* moments, ConvexHull* hull) {
  std::array<Vec3, 3> corners;
  std::size_t count = 0;
  vertexT* vertex = nullptr;
  vertexT** vertexp = nullptr;
  static_cast<void>(qh);
  FOREACHvertex_(facet->vertices) {
    if (count < 3) corners[count] = to_vec3(vertex->point) - origin;
    ++count;
  }
  if (count != 3) return;
  const Vec3 normal = to_vec3(facet->normal);
  const Vec3 cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  if (cross.dot(normal) < 0.0) std::swap(corners[1], corners[2]);
  moments->add(corners[0], corners[1], corners[2]);
  hull->area_m2 += 0.5 * cross.norm();
  hull->planes.push_back({normal, facet->offset});
}

}  // namespace

bool ConvexHull::contains(const Vec3& p, double margin_m) const {
  return std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    return plane.normal.dot(p) + plane.offset <= margin_m;
  });
}

std::optional<ConvexHull> convex_hull(std::span<const Vec3> points) {
  if (points.size() < 4) return std::nullopt;
  std::vector<double> coordinates;
  for (const Vec3& p : points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  Qhull qhull;
  if (!qhull.build(&coordinates)) return std::nullopt;
  qhT* const qh = qhull.state();
  const Vec3 origin =
      std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero())) / points.size();
  ConvexHull hull;
  Moments moments;
  facetT* facet = nullptr;
  FORALLfacets { add_facet(facet, qh, origin, &moments, &hull); }
  vertexT* vertex = nullptr;
  FORALLvertices { hull.vertices.push_back(to_vec3(vertex->point)); }
  if (!(moments.volume > 0.0)) return std::nullopt;
  const Vec3 mean = moments.first / moments.volume;
  hull.volume_m3 = moments.volume;
  hull.centroid = origin + mean;
  hull.covariance = moments.second / moments.volume - mean * mean.transpose();
  return hull;
}

}  // namespace canopeer
