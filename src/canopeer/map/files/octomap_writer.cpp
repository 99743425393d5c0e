#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/byte_order.h"
#include "canopeer/map/files/octomap_format.h"
#include "canopeer/map/files/paged_bytes.h"
#include "canopeer/map/octomap_file.h"

namespace canopeer {
namespace {

using namespace octomap_format;

enum class Layer { occupancy, roi };
enum class Precision { full, binary };

struct CodedBlock {
  std::uint64_t code;  // the bits of OctoMap's keys interleaved: an octree node is a range of codes
  BlockKey key;
};

std::uint64_t morton_code(const VoxelIndex& key) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < kTreeDepth; ++bit) {
    for (int axis = 0; axis < 3; ++axis) {
      code |= static_cast<std::uint64_t>(key[axis] >> bit & 1) << (3 * bit + axis);
    }
  }
  return code;
}

Expected<std::vector<CodedBlock>> blocks_in_tree_order(const VoxelMap& map) {
  std::vector<CodedBlock> blocks;
  for (const BlockKey key : map.block_keys()) {
    const VoxelIndex octomap_key = block_origin(key).array() + kKeyOffset;
    if ((octomap_key.array() < 0).any() || (octomap_key.array() >= 2 * kKeyOffset).any()) {
      return fail(
          "the map reaches beyond the 32768 voxels from the origin that OctoMap can hold; write "
          "a .cmap file instead");
    }
    blocks.push_back({morton_code(octomap_key), key});
  }
  std::sort(blocks.begin(), blocks.end(),
            [](const CodedBlock& a, const CodedBlock& b) { return a.code < b.code; });
  return blocks;
}

// Writes nodes in OctoMap's order (a node, then its children, depth first) straight from the
// blocks; an octomap::OcTree of the voxels before pruning would take gigabytes.
class TreeWriter {
 public:
  TreeWriter(const VoxelMap& map, Layer layer, Precision precision)
      : map_(map), roi_(layer == Layer::roi), binary_(precision == Precision::binary) {}

  void write(const std::vector<CodedBlock>& blocks) {
    if (!blocks.empty()) write_range(blocks.data(), blocks.data() + blocks.size(), kTreeDepth);
  }
  [[nodiscard]] const PagedBytes& data() const { return data_; }
  [[nodiscard]] std::size_t nodes() const { return nodes_; }

 private:
  struct Node {
    float value;  // log-odds; of a binary tree 1 (occupied) or 0 (free)
    bool leaf;
  };
  using Children = std::array<std::optional<Node>, 8>;

  // `level`: tree levels below the node.
  std::optional<Node> write_range(const CodedBlock* first, const CodedBlock* last, int level) {
    if (first == last) return std::nullopt;
    if (level == kBlockShift) {
      masks_ = map_.block(first->key);
      return write_cube(block_origin(first->key), level);
    }
    const std::size_t at = open_inner();
    Children children;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const CodedBlock* end = std::find_if(first, last, [&](const CodedBlock& block) {
        return (block.code >> (3 * (level - 1)) & 7) != i;
      });
      children[i] = write_range(first, end, level - 1);
      first = end;
    }
    return close_inner(at, children);
  }

  std::optional<Node> write_cube(const VoxelIndex& corner, int level) {
    if (level == 0) return write_voxel(corner);
    const std::size_t at = open_inner();
    Children children;
    for (int i = 0; i < 8; ++i) {
      children[static_cast<std::size_t>(i)] = write_cube(corner + child_step(i, level), level - 1);
    }
    return close_inner(at, children);
  }

  std::optional<Node> write_voxel(const VoxelIndex& voxel) {
    float log_odds = 0.0F;
    if (roi_) {
      // Never touched: the log-odds are 0 and the voxel is no ROI, whatever the threshold.
      log_odds = static_cast<float>(map_.roi_log_odds(voxel));
      if (log_odds == 0.0F && !masks_->roi.test(voxel)) return std::nullopt;
    } else {
      if (!masks_->observed.test(voxel)) return std::nullopt;
      log_odds = static_cast<float>(map_.occupancy_log_odds(voxel));
    }
    ++nodes_;
    if (binary_)
      return Node{(roi_ ? masks_->roi : masks_->occupied).test(voxel) ? 1.0F : 0.0F, true};
    data_.resize(data_.size() + kFullNodeBytes);
    fill_in_full(data_.size() - kFullNodeBytes, log_odds, 0);
    return Node{log_odds, true};
  }

  std::size_t open_inner() {
    ++nodes_;
    const std::size_t bytes = binary_ ? kBinaryNodeBytes : kFullNodeBytes;
    data_.resize(data_.size() + bytes);
    return data_.size() - bytes;
  }

  void fill_in_full(std::size_t at, float log_odds, unsigned children) {
    std::string bytes;
    append_number(bytes, log_odds);
    for (std::size_t i = 0; i < bytes.size(); ++i) data_[at + i] = bytes[i];
    data_[at + sizeof log_odds] = static_cast<char>(children);
  }

  void fill_in_binary(std::size_t at, const Children& children) {
    unsigned bits = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (!children[i]) continue;
      const unsigned leaf = children[i]->value > 0.0F ? kBinaryOccupied : kBinaryFree;
      bits |= (children[i]->leaf ? leaf : kBinaryInner) << (2 * i);
    }
    data_[at] = static_cast<char>(bits & 0xFFU);
    data_[at + 1] = static_cast<char>(bits >> 8);
  }

  // Drops a node without children, prunes one with eight equal leaves, else fills it in.
  std::optional<Node> close_inner(std::size_t at, const Children& children) {
    unsigned present = 0;
    bool equal_leaves = true;
    std::optional<float> highest;
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (!children[i]) {
        equal_leaves = false;
        continue;
      }
      present |= 1U << i;
      equal_leaves = equal_leaves && children[i]->leaf && children[0] &&
                     children[i]->value == children[0]->value;
      highest = std::max(highest.value_or(children[i]->value), children[i]->value);
    }
    if (!highest) {
      --nodes_;
      data_.resize(at);
      return std::nullopt;
    }
    if (equal_leaves) {
      nodes_ -= children.size();
      data_.resize(at);
      present = 0;
      if (!binary_) data_.resize(data_.size() + kFullNodeBytes);
    }
    if (!binary_) {
      fill_in_full(at, *highest, present);
    } else if (!equal_leaves) {
      fill_in_binary(at, children);
    }
    return Node{*highest, equal_leaves};
  }

  const VoxelMap& map_;
  const bool roi_;
  const bool binary_;
  const BlockMasks* masks_ = nullptr;  // of the block under way
  PagedBytes data_;
  std::size_t nodes_ = 0;
};

// The fewest digits that read back to the same number, with a point.
std::string shortest(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

Expected<void> write_tree(const VoxelMap& map, const std::filesystem::path& path, Layer layer,
                          Precision precision) {
  const auto blocks = blocks_in_tree_order(map);
  if (!blocks) return fail_in(path.string(), blocks.error());
  TreeWriter writer(map, layer, precision);
  writer.write(*blocks);
  const std::string header =
      std::string(precision == Precision::binary ? kBinaryFirstLine : kFullFirstLine) +
      "\n# (written by canopeer)\n#\nid OcTree\nsize " + std::to_string(writer.nodes()) + "\nres " +
      shortest(map.resolution_m()) + "\ndata\n";
  std::vector<std::string_view> pieces = writer.data().pieces();
  pieces.insert(pieces.begin(), header);
  return write_file(path, pieces);
}

Expected<std::string> nodes_of(const VoxelMap& map, Precision precision) {
  const auto blocks = blocks_in_tree_order(map);
  if (!blocks) return tl::unexpected(blocks.error());
  TreeWriter writer(map, Layer::occupancy, precision);
  writer.write(*blocks);
  std::string nodes;
  nodes.reserve(writer.data().size());
  for (const std::string_view piece : writer.data().pieces()) nodes += piece;
  return nodes;
}

}  // namespace

Expected<std::string> ot_nodes(const VoxelMap& map) { return nodes_of(map, Precision::full); }

Expected<std::string> bt_nodes(const VoxelMap& map) { return nodes_of(map, Precision::binary); }

Expected<void> write_ot(const VoxelMap& map, const std::filesystem::path& path) {
  return write_tree(map, path, Layer::occupancy, Precision::full);
}

Expected<void> write_bt(const VoxelMap& map, const std::filesystem::path& path) {
  return write_tree(map, path, Layer::occupancy, Precision::binary);
}

Expected<void> write_roi_ot(const VoxelMap& map, const std::filesystem::path& path) {
  return write_tree(map, path, Layer::roi, Precision::full);
}

Expected<void> write_roi_bt(const VoxelMap& map, const std::filesystem::path& path) {
  return write_tree(map, path, Layer::roi, Precision::binary);
}

}  // namespace canopeer
