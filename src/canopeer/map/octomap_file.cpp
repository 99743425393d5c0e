#include "canopeer/map/octomap_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

constexpr int kTreeDepth = 16;
constexpr int kKeyOffset = 1 << (kTreeDepth - 1);
constexpr std::size_t kNodeBytes = sizeof(float) + 1;  // log-odds, and which children there are
constexpr char kFirstLine[] = "# Octomap OcTree file";

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
      return fail("the map reaches beyond the 32768 voxels from the origin that OctoMap can hold");
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
  TreeWriter(const VoxelMap& map, bool roi) : map_(map), roi_(roi) {}

  void write(const std::vector<CodedBlock>& blocks) {
    if (!blocks.empty()) write_range(blocks.data(), blocks.data() + blocks.size(), kTreeDepth);
  }
  [[nodiscard]] const std::string& data() const { return data_; }
  [[nodiscard]] std::size_t nodes() const { return nodes_; }

 private:
  struct Node {
    float log_odds;
    bool leaf;
  };
  using Children = std::array<std::optional<Node>, 8>;

  // `level`: tree levels below the node.
  std::optional<Node> write_range(const CodedBlock* first, const CodedBlock* last, int level) {
    if (first == last) return std::nullopt;
    if (level == kBlockShift) return write_cube(first->key, block_origin(first->key), level);
    const std::size_t at = open_node();
    Children children;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const CodedBlock* end = std::find_if(first, last, [&](const CodedBlock& block) {
        return (block.code >> (3 * (level - 1)) & 7) != i;
      });
      children[i] = write_range(first, end, level - 1);
      first = end;
    }
    return close_node(at, children);
  }

  std::optional<Node> write_cube(BlockKey key, const VoxelIndex& corner, int level) {
    if (level == 0) return write_voxel(corner);
    const std::size_t at = open_node();
    Children children;
    for (int i = 0; i < 8; ++i) {
      const VoxelIndex step = VoxelIndex(i & 1, i >> 1 & 1, i >> 2) * (1 << (level - 1));
      children[static_cast<std::size_t>(i)] = write_cube(key, corner + step, level - 1);
    }
    return close_node(at, children);
  }

  std::optional<Node> write_voxel(const VoxelIndex& voxel) {
    // A ROI log-odds of exactly 0 is one that was never touched: no sum of steps comes back to it.
    const double log_odds = roi_ ? map_.roi_log_odds(voxel) : map_.occupancy_log_odds(voxel);
    const bool known = roi_ ? log_odds != 0.0 : map_.occupancy(voxel) != Occupancy::unknown;
    if (!known) return std::nullopt;
    const Node node{static_cast<float>(log_odds), true};
    fill_in(open_node(), node.log_odds, 0);
    return node;
  }

  std::size_t open_node() {
    ++nodes_;
    data_.append(kNodeBytes, '\0');
    return data_.size() - kNodeBytes;
  }

  void fill_in(std::size_t at, float log_odds, unsigned children) {
    std::memcpy(&data_[at], &log_odds, sizeof log_odds);
    data_[at + sizeof log_odds] = static_cast<char>(children);
  }

  // Drops a node without children, prunes one with eight equal leaves, else fills it in.
  std::optional<Node> close_node(std::size_t at, const Children& children) {
    unsigned bits = 0;
    bool equal_leaves = true;
    std::optional<float> highest;
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (!children[i]) {
        equal_leaves = false;
        continue;
      }
      bits |= 1U << i;
      equal_leaves = equal_leaves && children[i]->leaf && children[0] &&
                     children[i]->log_odds == children[0]->log_odds;
      highest = std::max(highest.value_or(children[i]->log_odds), children[i]->log_odds);
    }
    if (!highest) {
      --nodes_;
      data_.resize(at);
      return std::nullopt;
    }
    if (equal_leaves) {
      nodes_ -= children.size();
      data_.resize(at + kNodeBytes);
      bits = 0;
    }
    fill_in(at, *highest, bits);
    return Node{*highest, equal_leaves};
  }

  const VoxelMap& map_;
  bool roi_;
  std::string data_;
  std::size_t nodes_ = 0;
};

Expected<void> write_tree(const VoxelMap& map, const std::filesystem::path& path, bool roi) {
  const auto blocks = blocks_in_tree_order(map);
  if (!blocks) return fail_in(path.string(), blocks.error());
  TreeWriter writer(map, roi);
  writer.write(*blocks);
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header << kFirstLine << "\n# (written by canopeer)\n#\nid OcTree\nsize " << writer.nodes()
         << "\nres " << map.resolution_m() << "\ndata\n";
  return write_file(path, header.str() + writer.data());
}

// The resolution the header states; leaves the stream at the first node.
Expected<double> read_header(std::istream& stream) {
  std::string line;
  if (!std::getline(stream, line) || line.rfind(kFirstLine, 0) != 0) {
    return fail("not an OctoMap .ot file (the first line must be \"" + std::string(kFirstLine) +
                "\")");
  }
  std::string id;
  double resolution_m = 0.0;
  while (std::getline(stream, line) && line != "data") {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string key;
    words >> key;
    if (key == "id") words >> id;
    if (key == "res") words >> resolution_m;
  }
  if (!stream) return fail("the header has no line \"data\"");
  if (id != "OcTree") return fail("holds a tree of type \"" + id + "\", not OcTree");
  return resolution_m;
}

// Reads the nodes of a tree into a map. Checks every byte: OctoMap's own reader recurses without
// end on a file that was cut off.
class TreeReader {
 public:
  TreeReader(std::string_view data, VoxelMap& map) : data_(data), map_(map) {}

  Expected<void> read() {
    if (data_.empty()) return {};
    if (auto done = read_node(VoxelIndex::Constant(-kKeyOffset), kTreeDepth); !done) return done;
    if (!data_.empty()) return fail("there is more data than the tree needs");
    return {};
  }

 private:
  Expected<void> read_node(const VoxelIndex& corner, int level) {
    if (data_.size() < kNodeBytes) return fail("the file ends within the tree");
    float log_odds = 0.0F;
    std::memcpy(&log_odds, data_.data(), sizeof log_odds);
    const auto children = static_cast<unsigned char>(data_[sizeof log_odds]);
    data_.remove_prefix(kNodeBytes);
    if (children == 0) return set_cube(corner, level, static_cast<double>(log_odds));
    if (level == 0) return fail("the tree is deeper than 16 levels");
    for (int i = 0; i < 8; ++i) {
      if ((children >> i & 1) == 0) continue;
      const VoxelIndex step = VoxelIndex(i & 1, i >> 1 & 1, i >> 2) * (1 << (level - 1));
      if (auto done = read_node(corner + step, level - 1); !done) return done;
    }
    return {};
  }

  Expected<void> set_cube(const VoxelIndex& corner, int level, double log_odds) {
    if (!std::isfinite(log_odds)) return fail("a log-odds is not a number");
    voxels_ += std::int64_t{1} << (3 * level);
    if (voxels_ > kMaxVoxels) return fail("the tree holds more than 2^30 voxels");
    const int side = 1 << level;
    for (int z = 0; z < side; ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          map_.set_occupancy_log_odds(corner + VoxelIndex(x, y, z), log_odds);
        }
      }
    }
    return {};
  }

  static constexpr std::int64_t kMaxVoxels = std::int64_t{1} << 30;
  std::string_view data_;
  VoxelMap& map_;
  std::int64_t voxels_ = 0;
};

}  // namespace

Expected<void> write_ot(const VoxelMap& map, const std::filesystem::path& path) {
  return write_tree(map, path, false);
}

Expected<void> write_roi_ot(const VoxelMap& map, const std::filesystem::path& path) {
  return write_tree(map, path, true);
}

Expected<VoxelMap> read_ot(const std::filesystem::path& path, VoxelMapOptions options) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  std::istringstream stream(*bytes);
  stream.imbue(std::locale::classic());
  const auto resolution_m = read_header(stream);
  if (!resolution_m) return fail_in(path.string(), resolution_m.error());
  options.resolution_m = *resolution_m;
  if (const auto valid = options.validate(); !valid) return fail_in(path.string(), valid.error());
  VoxelMap map(options);
  const auto data = std::string_view(*bytes).substr(static_cast<std::size_t>(stream.tellg()));
  if (const auto done = TreeReader(data, map).read(); !done) {
    return fail_in(path.string(), done.error());
  }
  return map;
}

}  // namespace canopeer
