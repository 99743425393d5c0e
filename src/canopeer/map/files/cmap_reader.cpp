#include <zstd.h>

#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/byte_order.h"
#include "canopeer/map/cmap_file.h"
#include "canopeer/map/files/cmap_format.h"

namespace canopeer {
namespace {

using namespace cmap_format;

constexpr char kDamaged[] = "; the file was damaged: write or copy it again";

// Takes numbers off the front of bytes that are known to be there.
class Taker {
 public:
  explicit Taker(std::string_view bytes) : bytes_(bytes) {}
  template <typename T>
  T number() {
    return load_number<T>(take(sizeof(T)).data());
  }
  std::string_view take(std::size_t size) {
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  VoxelMask mask() {
    VoxelMask mask;
    for (std::uint64_t& slice : mask.slices) slice = number<std::uint64_t>();
    return mask;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

struct Header {
  VoxelMapOptions options;
  double unit = 0.0;
  std::uint64_t blocks = 0;
  std::int64_t observed = 0, occupied = 0, roi = 0;
};

Expected<Header> read_header(std::string_view bytes) {
  if (!is_cmap(bytes)) return fail("not a canopeer map (.cmap) file: it begins otherwise");
  if (bytes.size() < kMagic.size() + 4) return fail("the file ends within its header: cut off");
  Taker taker(bytes.substr(kMagic.size()));
  const auto version = taker.number<std::uint32_t>();
  if (version != kVersion) {
    return fail("has format version " + std::to_string(version) + ", this program reads version " +
                std::to_string(kVersion));
  }
  if (bytes.size() < kHeaderBytes) return fail("the file ends within its header: cut off");
  const std::string_view checked = bytes.substr(0, kHeaderBytes - 4);
  if (checksum(checked) != load_number<std::uint32_t>(bytes.data() + checked.size())) {
    return fail("the checksum of the header is wrong" + std::string(kDamaged));
  }
  Header header;
  for (double* option :
       {&header.options.resolution_m, &header.options.hit_probability,
        &header.options.miss_probability, &header.options.clamp_min, &header.options.clamp_max,
        &header.options.occupied_threshold, &header.unit}) {
    *option = taker.number<double>();
  }
  header.blocks = taker.number<std::uint64_t>();
  for (std::int64_t* count : {&header.observed, &header.occupied, &header.roi}) {
    *count = taker.number<std::int64_t>();
  }
  if (const auto valid = header.options.validate(); !valid) return tl::unexpected(valid.error());
  if (header.unit != kLogOddsUnit) return fail("its log-odds have another unit than 1/2048");
  return header;
}

struct Group {
  std::vector<BlockKey> keys;
  std::string_view compressed;
};

// Takes a group off the front of `rest`, its checksum checked.
Expected<Group> take_group(std::string_view& rest) {
  Taker taker(rest);
  const auto cut_off = [] { return fail("the file ends within a group of blocks: cut off"); };
  if (taker.left() < kGroupFrameBytes) return cut_off();
  const auto blocks = taker.number<std::uint32_t>();
  const auto compressed = taker.number<std::uint32_t>();
  const std::uint64_t body = std::uint64_t{blocks} * sizeof(BlockKey) + compressed;
  if (taker.left() < body + 4) return cut_off();
  Group group;
  const std::string_view checked = rest.substr(0, rest.size() - taker.left() + body);
  const std::string_view keys = taker.take(blocks * sizeof(BlockKey));
  group.compressed = taker.take(compressed);
  if (checksum(checked) != taker.number<std::uint32_t>()) {
    return fail("the checksum of a group of blocks is wrong" + std::string(kDamaged));
  }
  if (blocks == 0 || blocks > kGroupBlocks) {
    return fail("a group has " + std::to_string(blocks) + " blocks, 1 to " +
                std::to_string(kGroupBlocks) + " are expected");
  }
  for (Taker key(keys); key.left() > 0;) group.keys.push_back(key.number<BlockKey>());
  rest.remove_prefix(checked.size() + 4);
  return group;
}

Expected<std::string> decompress(const Group& group) {
  const auto size = ZSTD_getFrameContentSize(group.compressed.data(), group.compressed.size());
  if (size < group.keys.size() * 2 * kMaskBytes || size > group.keys.size() * kMaxBlockBytes) {
    return fail("a group of blocks states an impossible size");  // zstd's error codes are among it
  }
  std::string content(static_cast<std::size_t>(size), '\0');
  const std::size_t got = ZSTD_decompress(content.data(), content.size(), group.compressed.data(),
                                          group.compressed.size());
  if (got != content.size()) return fail("a group of blocks cannot be decompressed");
  return content;
}

Expected<void> add_group(const Group& group, std::string_view content, VoxelMap& map) {
  Taker taker(content);
  std::vector<VoxelMask> observed(group.keys.size());
  std::vector<VoxelMask> roi(group.keys.size());
  std::size_t values = 0;
  for (auto* masks : {&observed, &roi}) {
    for (VoxelMask& mask : *masks) {
      mask = taker.mask();
      values += static_cast<std::size_t>(mask.count());
    }
  }
  if (taker.left() != values * sizeof(std::int16_t)) {
    return fail("a group of blocks has more or fewer values than voxels");
  }
  const auto log_odds = [&] { return taker.number<std::int16_t>() * kLogOddsUnit; };
  for (std::size_t i = 0; i < group.keys.size(); ++i) {
    for_each_voxel(group.keys[i], observed[i],
                   [&](const VoxelIndex& voxel) { map.set_occupancy_log_odds(voxel, log_odds()); });
  }
  for (std::size_t i = 0; i < group.keys.size(); ++i) {
    for_each_voxel(group.keys[i], roi[i],
                   [&](const VoxelIndex& voxel) { map.set_roi_log_odds(voxel, log_odds()); });
  }
  return {};
}

// Keys rise through the whole file, so that no block comes twice.
Expected<void> check_order(const std::vector<BlockKey>& keys, BlockKey& at_least) {
  for (const BlockKey key : keys) {
    if (key < at_least || key >> 63 != 0) return fail("its blocks are not in order");
    at_least = key + 1;
  }
  return {};
}

}  // namespace

bool is_cmap(std::string_view bytes) { return bytes.starts_with(kMagic); }

Expected<VoxelMap> parse_cmap(std::string_view bytes) {
  const auto header = read_header(bytes);
  if (!header) return tl::unexpected(header.error());
  VoxelMap map(header->options);
  BlockKey at_least = 0;
  std::uint64_t blocks = 0;
  for (std::string_view rest = bytes.substr(kHeaderBytes); !rest.empty();) {
    const auto group = take_group(rest);
    if (!group) return tl::unexpected(group.error());
    if (auto ordered = check_order(group->keys, at_least); !ordered) {
      return tl::unexpected(ordered.error());
    }
    const auto content = decompress(*group);
    if (!content) return tl::unexpected(content.error());
    if (auto added = add_group(*group, *content, map); !added) {
      return tl::unexpected(added.error());
    }
    blocks += group->keys.size();
  }
  if (blocks < header->blocks) {
    return fail("holds " + std::to_string(blocks) + " of " + std::to_string(header->blocks) +
                " blocks: the file was cut off");
  }
  if (blocks > header->blocks || map.observed_voxels() != header->observed ||
      map.occupied_voxels() != header->occupied || map.roi_voxels() != header->roi) {
    return fail("its voxels are not as many as the header says");
  }
  return map;
}

Expected<VoxelMap> read_cmap(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto map = parse_cmap(*bytes);
  if (!map) return fail_in(path.string(), map.error());
  return map;
}

}  // namespace canopeer
