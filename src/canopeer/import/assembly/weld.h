#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace canopeer {

/// For each point the index of the first one that it is joined with: points at most `tolerance_m`
/// apart are one, chains of them too. Mesh files give every triangle vertices of its own; this says
/// which triangles hang together. Deterministic; time and memory grow with the number of points.
[[nodiscard]] std::vector<std::uint32_t> weld(std::span<const Eigen::Vector3f> points,
                                              double tolerance_m);

/// Sets of indices that grow together.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);
  /// The smallest index of the set `i` is in.
  [[nodiscard]] std::uint32_t find(std::uint32_t i);
  void join(std::uint32_t a, std::uint32_t b);

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace canopeer
