#include "canopeer/import/assembly/weld.h"

#include <cmath>
#include <numeric>
#include <unordered_map>

namespace canopeer {
namespace {

using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    auto h = static_cast<std::uint64_t>(c.x()) * 0x9e3779b97f4a7c15ULL;
    h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(c.y()) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 32)) + static_cast<std::uint64_t>(c.z()) * 0x94d049bb133111ebULL;
    return static_cast<std::size_t>(h ^ (h >> 31));
  }
};

}  // namespace

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0U);
}

std::uint32_t DisjointSets::find(std::uint32_t i) {
  while (parent_[i] != i) {
    parent_[i] = parent_[parent_[i]];
    i = parent_[i];
  }
  return i;
}

void DisjointSets::join(std::uint32_t a, std::uint32_t b) {
  a = find(a);
  b = find(b);
  if (a < b) parent_[b] = a;
  if (b < a) parent_[a] = b;
}

std::vector<std::uint32_t> weld(std::span<const Eigen::Vector3f> points, double tolerance_m) {
  DisjointSets sets(points.size());
  // Cells of twice the tolerance: a neighbour is in one of the eight cells around the point's own
  // nearest corner. One point a cell and set is kept, which is enough for what is that close.
  const double size = 2.0 * tolerance_m;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
  cells.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i].cast<double>();
    const Eigen::Vector3d q = p / size - Eigen::Vector3d::Constant(0.5);
    const Cell low = q.array().floor().cast<std::int64_t>().matrix();
    for (int k = 0; k < 8; ++k) {
      const auto found = cells.find(low + Cell(k & 1, (k >> 1) & 1, (k >> 2) & 1));
      if (found == cells.end()) continue;
      for (const std::uint32_t j : found->second) {
        if ((points[j].cast<double>() - p).norm() <= tolerance_m) sets.join(i, j);
      }
    }
    auto& own = cells[(p / size).array().floor().cast<std::int64_t>().matrix()];
    // Exact copies, by far the most, need no second entry.
    bool copy = false;
    for (const std::uint32_t j : own) copy = copy || points[j] == points[i];
    if (!copy) own.push_back(i);
  }
  std::vector<std::uint32_t> first(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) first[i] = sets.find(i);
  return first;
}

}  // namespace canopeer
