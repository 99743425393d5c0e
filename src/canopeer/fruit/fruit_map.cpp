#include "canopeer/fruit/fruit_map.h"

#include <algorithm>

#include "canopeer/base/check.h"
#include "canopeer/fruit/fruit_ids.h"
#include "canopeer/fruit/fruit_separation.h"
#include "canopeer/fruit/piece_filter.h"
#include "canopeer/fruit/seen_share.h"
#include "canopeer/fruit/surface_cells.h"
#include "canopeer/fruit/voxel_clusters.h"

namespace canopeer {
namespace {

constexpr double kTouchingBlocks = 1.75;  // reaches the 26 blocks around one

/// Cells near each other that are solved together.
struct Block {
  std::vector<int> cells;
  bool changed = false;
};

struct KnownFruit {
  FruitEstimate estimate;
  int block = 0;  ///< some block of the group it was found in
};

FruitEstimate to_estimate(const SeparatedFruit& fruit, const std::vector<SurfacePoint>& surface,
                          const FruitMapOptions& options) {
  const ShapeEstimate& shape = fruit.shape;
  FruitEstimate estimate;
  estimate.centre = shape.centre;
  estimate.semi_axes_m = {shape.radius_m, shape.radius_m, shape.half_length_m};
  estimate.volume_cm3 = shape.volume_cm3();
  estimate.points = static_cast<int>(fruit.points.size());
  // Half the surface seen, lying well on an ellipsoid, is about as sure as it gets.
  const double seen = std::min(1.0, 2.0 * seen_share(shape, surface, fruit.points));
  const double fit = 1.0 - 0.5 * shape.rms_m / options.max_rms_m;
  estimate.confidence = std::clamp(seen * fit, 0.0, 1.0);
  return estimate;
}

}  // namespace

/// Blocks that touch are a group. A group is solved anew when one of its cells changed; all others
/// keep their fruits.
struct FruitMap::State {
  explicit State(const FruitMapOptions& o)
      : options(o), cells(o), pieces(o.cluster_tolerance_m / o.cell_m), groups(kTouchingBlocks) {}

  FruitMapOptions options;
  SurfaceCells cells;
  VoxelClusters pieces;               // Euclidean clusters of the cells that count
  std::vector<int> piece_of_cell;     // number in `pieces`, −1: the cell does not count yet
  VoxelClusters groups;               // of blocks
  std::vector<Block> blocks;          // by number in `groups`
  std::vector<KnownFruit> known;      // by ascending id
  std::vector<FruitEstimate> fruits;  // the same, as handed out
  FruitIds ids;

  void note_change(int cell);
  [[nodiscard]] std::vector<int> changed_groups();
  [[nodiscard]] std::vector<SurfacePoint> surface_of_group(int group) const;
};

void FruitMap::State::note_change(int cell) {
  piece_of_cell.resize(cells.cells().size(), -1);
  const VoxelIndex& index = cells.cells()[cell].index;
  const Vec3 centre = voxel_centre(index, options.cell_m);
  const int block = groups.insert(voxel_at(centre, options.group_distance_m));
  if (static_cast<std::size_t>(block) == blocks.size()) blocks.emplace_back();
  blocks[block].changed = true;
  if (piece_of_cell[cell] >= 0) return;
  piece_of_cell[cell] = pieces.insert(index);
  blocks[block].cells.push_back(cell);
}

/// Roots of the groups with a change, ascending; forgets the changes.
std::vector<int> FruitMap::State::changed_groups() {
  std::vector<int> changed;
  for (int block = 0; block < groups.size(); ++block) {
    if (blocks[block].changed) changed.push_back(groups.root(block));
    blocks[block].changed = false;
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

/// The group's surface without the pieces that are too small or too long.
std::vector<SurfacePoint> FruitMap::State::surface_of_group(int group) const {
  std::vector<int> members;
  for (int block = 0; block < groups.size(); ++block) {
    if (groups.root(block) != group) continue;
    members.insert(members.end(), blocks[block].cells.begin(), blocks[block].cells.end());
  }
  std::sort(members.begin(), members.end());
  std::vector<SurfacePoint> surface;
  std::vector<int> piece;
  for (const int cell : members) {
    const SurfaceCell& c = cells.cells()[cell];
    surface.push_back({c.point(), c.normal()});
    piece.push_back(pieces.root(piece_of_cell[cell]));
  }
  return without_odd_pieces(surface, piece, options);
}

FruitMap::FruitMap(const FruitMapOptions& options) : state_(std::make_unique<State>(options)) {
  CANOPEER_CHECK(options.validate().has_value(), "validate options where they come from");
}
FruitMap::~FruitMap() = default;
FruitMap::FruitMap(FruitMap&&) noexcept = default;
FruitMap& FruitMap::operator=(FruitMap&&) noexcept = default;

void FruitMap::add(const RgbdFrame& frame, const Mask& fruit) {
  for (const int cell : state_->cells.add(frame, fruit)) state_->note_change(cell);
}

void FruitMap::update() {
  State& s = *state_;
  const std::vector<int> changed = s.changed_groups();
  std::vector<FruitEstimate> before;
  std::erase_if(s.known, [&](const KnownFruit& fruit) {
    const int group = s.groups.root(fruit.block);
    if (!std::binary_search(changed.begin(), changed.end(), group)) return false;
    before.push_back(fruit.estimate);
    return true;
  });
  std::vector<FruitEstimate> found;
  std::vector<int> group_of_found;
  for (const int group : changed) {
    const std::vector<SurfacePoint> surface = s.surface_of_group(group);
    for (const SeparatedFruit& fruit : separate_fruits(surface, s.options)) {
      found.push_back(to_estimate(fruit, surface, s.options));
      group_of_found.push_back(group);
    }
  }
  s.ids.assign(found, before, s.options.id_distance_m);
  for (std::size_t i = 0; i < found.size(); ++i) s.known.push_back({found[i], group_of_found[i]});
  std::sort(s.known.begin(), s.known.end(),
            [](const KnownFruit& a, const KnownFruit& b) { return a.estimate.id < b.estimate.id; });
  s.fruits.clear();
  for (const KnownFruit& fruit : s.known) s.fruits.push_back(fruit.estimate);
}

const std::vector<FruitEstimate>& FruitMap::fruits() const { return state_->fruits; }

PointCloud FruitMap::cloud() const {
  PointCloud cloud;
  const std::vector<SurfaceCell>& cells = state_->cells.cells();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!state_->cells.counts(static_cast<int>(i))) continue;
    cloud.points.push_back(cells[i].point().cast<float>());
    cloud.normals.push_back(cells[i].normal().cast<float>());
    cloud.colors.push_back(cells[i].color());
  }
  return cloud;
}

}  // namespace canopeer
