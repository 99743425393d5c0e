#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/byte_order.h"
#include "canopeer/base/text_lines.h"
#include "canopeer/map/files/octomap_format.h"
#include "canopeer/map/octomap_file.h"

namespace canopeer {
namespace {

using namespace octomap_format;

struct TreeHeader {
  bool binary = false;
  std::string id;
  std::int64_t nodes = -1;
  double resolution_m = 0.0;
  std::size_t color_bytes = 0;  // of every full node, between its log-odds and its children
  std::string_view data;
};

Expected<TreeHeader> read_tree_header(std::string_view bytes) {
  TextLines lines(bytes);
  const std::string_view first = lines.next().value_or("");
  TreeHeader header;
  header.binary = first.starts_with(kBinaryFirstLine);
  if (!header.binary && !first.starts_with(kFullFirstLine)) {
    return fail("not an OctoMap file (the first line must be \"" + std::string(kFullFirstLine) +
                "\" or \"" + kBinaryFirstLine + "\")");
  }
  for (;;) {
    const auto line = lines.next();
    if (!line) return fail("the header has no line \"data\": the file was cut off, or is no tree");
    if (*line == "data") break;
    const auto words = words_of(*line);
    if (words.size() != 2) continue;
    if (words[0] == "id") header.id = words[1];
    if (words[0] == "size") header.nodes = to_integer(words[1]).value_or(-1);
    if (words[0] == "res") header.resolution_m = to_number(words[1]).value_or(0.0);
  }
  if (header.id == "ColorOcTree") {
    header.color_bytes = 3;
  } else if (header.id != "OcTree" && header.id != "OcTreeStamped") {
    return fail("holds a tree of type \"" + header.id +
                "\"; OcTree, OcTreeStamped and ColorOcTree can be read");
  }
  if (header.nodes < 0) return fail("the header has no line \"size\" with the number of nodes");
  header.data = lines.rest();
  return header;
}

// What becomes of the leaves.
class VoxelSink {
 public:
  VoxelSink(VoxelMap& map, bool roi) : map_(map), roi_(roi) {
    const auto log_odds = [](double p) { return std::log(p / (1.0 - p)); };
    free_ = log_odds(map.options().clamp_min);
    occupied_ = log_odds(map.options().clamp_max);
  }
  void set_cube(const VoxelIndex& corner, int side, double log_odds) {
    for (int z = 0; z < side; ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const VoxelIndex voxel = corner + VoxelIndex(x, y, z);
          roi_ ? map_.set_roi_log_odds(voxel, log_odds)
               : map_.set_occupancy_log_odds(voxel, log_odds);
        }
      }
    }
  }
  [[nodiscard]] double free_log_odds() const { return free_; }
  [[nodiscard]] double occupied_log_odds() const { return occupied_; }

 private:
  VoxelMap& map_;
  bool roi_;
  double free_, occupied_;
};

// Reads the nodes of a tree. OctoMap's own reader takes an `.ot` file that was cut off for a whole
// one, and recurses as deep as damaged bytes tell it.
class TreeReader {
 public:
  TreeReader(const TreeHeader& header, VoxelSink sink)
      : data_(header.data), header_(header), sink_(sink) {
    // Real trees average a few voxels a node. A small file may fill 256³ voxels, a larger one 16³ a
    // node, none more than 2^31 (6 GB of map).
    const std::size_t smallest_node = header.binary ? kBinaryNodeBytes : kFullNodeBytes;
    const auto possible_nodes = static_cast<std::int64_t>(data_.size() / smallest_node + 1);
    max_voxels_ = std::clamp(possible_nodes << 12, std::int64_t{1} << 24, std::int64_t{1} << 31);
  }

  Expected<void> read() {
    if (data_.empty() && header_.nodes == 0) return {};
    const VoxelIndex corner = VoxelIndex::Constant(-kKeyOffset);
    ++nodes_;
    const auto done =
        header_.binary ? read_binary(corner, kTreeDepth) : read_full(corner, kTreeDepth);
    if (!done) return done;
    if (!data_.empty()) return fail("there is more data than the tree needs");
    if (nodes_ != header_.nodes) {
      return fail("the tree has " + std::to_string(nodes_) + " nodes, the header says " +
                  std::to_string(header_.nodes));
    }
    return {};
  }

 private:
  static tl::unexpected<Error> cut_off() {
    return fail("the file ends within the tree: it was cut off; copy or write it again");
  }
  static tl::unexpected<Error> too_deep() {
    return fail("the tree is deeper than 16 levels: the file was damaged");
  }

  Expected<void> read_full(const VoxelIndex& corner, int level) {
    const std::size_t bytes = kFullNodeBytes + header_.color_bytes;
    if (data_.size() < bytes) return cut_off();
    const auto log_odds = static_cast<double>(load_number<float>(data_.data()));
    const auto children = static_cast<unsigned char>(data_[bytes - 1]);
    data_.remove_prefix(bytes);
    if (children == 0) return leaf(corner, level, log_odds);
    if (level == 0) return too_deep();
    for (int i = 0; i < 8; ++i) {
      if ((children >> i & 1) == 0) continue;
      ++nodes_;
      if (auto done = read_full(corner + child_step(i, level), level - 1); !done) return done;
    }
    return {};
  }

  Expected<void> read_binary(const VoxelIndex& corner, int level) {
    if (data_.size() < kBinaryNodeBytes) return cut_off();
    const unsigned children = load_number<std::uint16_t>(data_.data());
    data_.remove_prefix(kBinaryNodeBytes);
    if (level == 0) return too_deep();
    for (int i = 0; i < 8; ++i) {
      const unsigned kind = children >> (2 * i) & 3;
      if (kind == 0) continue;
      ++nodes_;
      const VoxelIndex child = corner + child_step(i, level);
      const auto done =
          kind == kBinaryInner
              ? read_binary(child, level - 1)
              : leaf(child, level - 1,
                     kind == kBinaryFree ? sink_.free_log_odds() : sink_.occupied_log_odds());
      if (!done) return done;
    }
    return {};
  }

  Expected<void> leaf(const VoxelIndex& corner, int level, double log_odds) {
    if (!std::isfinite(log_odds)) return fail("a log-odds is not a number");
    voxels_ += std::int64_t{1} << (3 * level);
    if (voxels_ > max_voxels_) {
      return fail("the tree would fill more than " + std::to_string(max_voxels_) +
                  " voxels, more than a file of this size can mean");
    }
    sink_.set_cube(corner, 1 << level, log_odds);
    return {};
  }

  std::string_view data_;
  const TreeHeader& header_;
  VoxelSink sink_;
  std::int64_t max_voxels_ = 0;
  std::int64_t voxels_ = 0;
  std::int64_t nodes_ = 0;
};

}  // namespace

bool is_octomap(std::string_view bytes) {
  return bytes.starts_with(kFullFirstLine) || bytes.starts_with(kBinaryFirstLine);
}

Expected<VoxelMap> parse_octomap(std::string_view bytes, VoxelMapOptions options) {
  const auto header = read_tree_header(bytes);
  if (!header) return tl::unexpected(header.error());
  options.resolution_m = header->resolution_m;
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  VoxelMap map(options);
  const auto done = TreeReader(*header, VoxelSink(map, false)).read();
  if (!done) return tl::unexpected(done.error());
  return map;
}

Expected<void> parse_octomap_roi(std::string_view bytes, VoxelMap& map) {
  const auto header = read_tree_header(bytes);
  if (!header) return tl::unexpected(header.error());
  if (header->resolution_m != map.resolution_m()) {
    return fail("its resolution is " + std::to_string(header->resolution_m) +
                " m, that of the occupancy tree " + std::to_string(map.resolution_m()) + " m");
  }
  return TreeReader(*header, VoxelSink(map, true)).read();
}

Expected<VoxelMap> read_octomap(const std::filesystem::path& path, VoxelMapOptions options) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto map = parse_octomap(*bytes, options);
  if (!map) return fail_in(path.string(), map.error());
  return map;
}

Expected<void> read_octomap_roi(const std::filesystem::path& path, VoxelMap& map) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  if (const auto done = parse_octomap_roi(*bytes, map); !done) {
    return fail_in(path.string(), done.error());
  }
  return {};
}

}  // namespace canopeer
