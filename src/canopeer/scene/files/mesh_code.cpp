#include "canopeer/scene/files/mesh_code.h"

#include <algorithm>
#include <cmath>

namespace canopeer {
namespace {

/// An edge and the corner of a triangle that lies across from it.
struct Edge {
  std::uint32_t low, high, across;
};

std::vector<Edge> sorted_edges(const Topology& topology) {
  std::vector<Edge> edges;
  edges.reserve(topology.triangles.size() * 3);
  for (const auto& t : topology.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), t[(i + 2) % 3]});
    }
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
    return x.low != y.low ? x.low < y.low : x.high < y.high;
  });
  return edges;
}

float sign(float x) { return x < 0.0F ? -1.0F : 1.0F; }

std::int8_t to_level(float share) {
  return static_cast<std::int8_t>(std::lround(std::clamp(share, -1.0F, 1.0F) * 127.0F));
}

}  // namespace

VertexPredictor::VertexPredictor(const Topology& topology) : corners_(topology.vertices) {
  const std::vector<Edge> edges = sorted_edges(topology);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const Edge& one = edges[i];
    const Edge& two = edges[i + 1];
    if (one.low != two.low || one.high != two.high) continue;
    // The two triangles are nearly a parallelogram: low + high = across + across.
    const std::uint32_t newest = std::max({one.high, one.across, two.across});
    Corner& corner = corners_[newest];
    const bool twice = one.low == newest || one.across == two.across ||
                       (newest == one.high) == (newest == one.across || newest == two.across);
    if (corner.known || twice) continue;
    if (newest == one.high) {
      corner = {one.across, two.across, one.low, true};
    } else {
      corner = {one.low, one.high, newest == one.across ? two.across : one.across, true};
    }
  }
}

GridPoint VertexPredictor::expected(std::size_t index, const std::vector<GridPoint>& points,
                                    const GridPoint& before) const {
  const Corner& corner = corners_[index];
  if (!corner.known) return index == 0 ? before : points[index - 1];
  GridPoint point{};
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = points[corner.a][i] + points[corner.b][i] - points[corner.across][i];
  }
  return point;
}

void append_topology(std::string& bytes, const Topology& topology) {
  append_varint(bytes, topology.vertices);
  append_varint(bytes, topology.triangles.size());
  std::int64_t last = 0;
  for (const auto& t : topology.triangles) {
    for (const std::uint32_t index : t) {
      append_signed(bytes, static_cast<std::int64_t>(index) - last);
      last = index;
    }
  }
}

Topology take_topology(ByteTaker& taker, std::uint64_t most_triangles) {
  Topology topology;
  topology.vertices = static_cast<std::uint32_t>(taker.bounded(0xFFFFFFFFU));
  const std::uint64_t count = taker.bounded(std::min<std::uint64_t>(most_triangles, taker.left()));
  std::int64_t last = 0;
  for (std::uint64_t k = 0; k < count && taker.ok(); ++k) {
    std::array<std::uint32_t, 3> t{};
    for (std::uint32_t& index : t) {
      const std::int64_t step = taker.signed_varint();
      if (step < -last || step >= static_cast<std::int64_t>(topology.vertices) - last) {
        taker.take(taker.left() + 1);  // no such vertex
        return {};
      }
      last += step;
      index = static_cast<std::uint32_t>(last);
    }
    topology.triangles.push_back(t);
  }
  return topology;
}

PackedNormal pack_normal(const std::array<float, 3>& n) {
  const float sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
  if (!(sum > 0.0F)) return {0, 0};
  float u = n[0] / sum;
  float v = n[1] / sum;
  if (n[2] < 0.0F) {
    const float folded = (1.0F - std::abs(v)) * sign(u);
    v = (1.0F - std::abs(u)) * sign(v);
    u = folded;
  }
  return {to_level(u), to_level(v)};
}

std::array<float, 3> unpack_normal(const PackedNormal& packed) {
  float u = std::max(-1.0F, static_cast<float>(packed[0]) / 127.0F);
  float v = std::max(-1.0F, static_cast<float>(packed[1]) / 127.0F);
  const float z = 1.0F - std::abs(u) - std::abs(v);
  if (z < 0.0F) {
    const float folded = (1.0F - std::abs(v)) * sign(u);
    v = (1.0F - std::abs(u)) * sign(v);
    u = folded;
  }
  const float length = std::sqrt(u * u + v * v + z * z);
  if (!(length > 0.0F)) return {0.0F, 0.0F, 1.0F};
  return {u / length, v / length, z / length};
}

}  // namespace canopeer
