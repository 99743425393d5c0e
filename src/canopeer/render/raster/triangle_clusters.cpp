#include "canopeer/render/raster/triangle_clusters.h"

#include <algorithm>
#include <limits>

namespace canopeer {
namespace {

Eigen::Vector3f corner_sum(const SurfaceSoup& soup, std::uint32_t triangle) {
  const auto& t = soup.triangles[triangle].vertex;
  return soup.vertices[t[0]] + soup.vertices[t[1]] + soup.vertices[t[2]];
}

class Grouping {
 public:
  Grouping(const SurfaceSoup& soup, TriangleClusters* out) : soup_(soup), out_(*out) {
    local_.resize(soup.vertices.size());
    group_of_.resize(soup.vertices.size(), 0);
  }

  /// Halves at the median along the longest axis until the groups are small; full groups first.
  void split(std::uint32_t* begin, std::uint32_t* end) {
    const auto count = static_cast<std::size_t>(end - begin);
    if (count == 0) return;
    if (count <= TriangleClusters::kMaxTriangles) return add(begin, end);
    const std::size_t groups =
        (count + TriangleClusters::kMaxTriangles - 1) / TriangleClusters::kMaxTriangles;
    std::uint32_t* middle = begin + groups / 2 * count / groups;
    Eigen::AlignedBox3f reach;
    for (const std::uint32_t* t = begin; t != end; ++t) reach.extend(corner_sum(soup_, *t));
    Eigen::Index axis = 0;
    reach.sizes().maxCoeff(&axis);
    std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
      const float at_a = corner_sum(soup_, a)[axis];
      const float at_b = corner_sum(soup_, b)[axis];
      return at_a != at_b ? at_a < at_b : a < b;
    });
    // nth_element leaves the order inside the halves to the library.
    std::sort(begin, middle);
    std::sort(middle, end);
    split(begin, middle);
    split(middle, end);
  }

 private:
  void add(const std::uint32_t* begin, const std::uint32_t* end) {
    ++group_;
    TriangleClusters::Cluster cluster;
    cluster.first_vertex = static_cast<std::uint32_t>(out_.x.size());
    cluster.first_triangle = static_cast<std::uint32_t>(out_.triangles.size());
    cluster.triangles = static_cast<std::uint8_t>(end - begin);
    cluster.cut = *begin >= soup_.first_cut;
    Eigen::AlignedBox3f box;
    for (const std::uint32_t* t = begin; t != end; ++t) {
      std::array<std::uint8_t, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) corners[i] = local(soup_.triangles[*t].vertex[i], &box);
      out_.corners.push_back(corners);
      out_.triangles.push_back(*t);
    }
    used_ = 0;
    while ((out_.x.size() - cluster.first_vertex) % TriangleClusters::kPadding != 0) {
      out_.x.push_back(out_.x.back());
      out_.y.push_back(out_.y.back());
      out_.z.push_back(out_.z.back());
    }
    cluster.vertices = static_cast<std::uint8_t>(out_.x.size() - cluster.first_vertex);
    cluster.centre = box.center();
    constexpr float kRoundedUp = 1.0F + 4.0F * std::numeric_limits<float>::epsilon();
    cluster.half = (box.max() - cluster.centre).cwiseMax(cluster.centre - box.min()) * kRoundedUp;
    out_.clusters.push_back(cluster);
    out_.bounds.extend(box.min().cast<double>());
    out_.bounds.extend(box.max().cast<double>());
  }

  /// Number of a vertex in the group at hand.
  std::uint8_t local(std::uint32_t vertex, Eigen::AlignedBox3f* box) {
    if (group_of_[vertex] != group_) {
      group_of_[vertex] = group_;
      local_[vertex] = used_++;
      const Eigen::Vector3f& p = soup_.vertices[vertex];
      out_.x.push_back(p.x());
      out_.y.push_back(p.y());
      out_.z.push_back(p.z());
      box->extend(p);
    }
    return local_[vertex];
  }

  const SurfaceSoup& soup_;
  TriangleClusters& out_;
  std::vector<std::uint8_t> local_;
  std::vector<std::uint32_t> group_of_;
  std::uint32_t group_ = 0;
  std::uint8_t used_ = 0;
};

}  // namespace

TriangleClusters make_triangle_clusters(const SurfaceSoup& soup) {
  TriangleClusters out;
  Grouping grouping(soup, &out);
  std::vector<std::uint32_t> order(soup.triangles.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  // A part's triangles follow each other.
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && soup.triangles[end].part == soup.triangles[begin].part) ++end;
    grouping.split(order.data() + begin, order.data() + end);
  }
  for (auto* v : {&out.x, &out.y, &out.z}) v->shrink_to_fit();
  out.corners.shrink_to_fit();
  out.triangles.shrink_to_fit();
  out.clusters.shrink_to_fit();
  return out;
}

}  // namespace canopeer
