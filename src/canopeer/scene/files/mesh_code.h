#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "canopeer/scene/files/byte_streams.h"

namespace canopeer {

/// Which vertices the triangles of a mesh join. Leaves, tubes and fruits of one kind share theirs.
struct Topology {
  std::uint32_t vertices = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A vertex in steps of the grid.
using GridPoint = std::array<std::int64_t, 3>;

/// What a vertex is expected to be from those before it: the fourth corner of a parallelogram with
/// the triangles around it (Touma & Gotsman, "Triangle mesh compression", Graphics Interface 1998),
/// or where there is none, the vertex before. What is written is the difference.
class VertexPredictor {
 public:
  explicit VertexPredictor(const Topology& topology);

  /// Of vertex `index`; `points` holds the vertices before it, `before` stands in for the one
  /// before the first.
  [[nodiscard]] GridPoint expected(std::size_t index, const std::vector<GridPoint>& points,
                                   const GridPoint& before) const;

 private:
  /// vertex = a + b − across.
  struct Corner {
    std::uint32_t a = 0, b = 0, across = 0;
    bool known = false;
  };
  std::vector<Corner> corners_;
};

/// Indices as differences from the one before, as varints.
void append_topology(std::string& bytes, const Topology& topology);
/// Takes at most `most_triangles`; each index is below `vertices`, else the taker is no longer
/// ok().
[[nodiscard]] Topology take_topology(ByteTaker& taker, std::uint64_t most_triangles);

/// A unit vector in two bytes: the octahedron's faces unfolded to a square (Meyer et al., "On
/// floating-point normal vectors", EGSR 2010).
using PackedNormal = std::array<std::int8_t, 2>;
[[nodiscard]] PackedNormal pack_normal(const std::array<float, 3>& normal);
[[nodiscard]] std::array<float, 3> unpack_normal(const PackedNormal& packed);

}  // namespace canopeer
