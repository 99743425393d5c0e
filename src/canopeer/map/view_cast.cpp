#include "canopeer/map/view_cast.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "canopeer/base/check.h"
#include "canopeer/geometry/voxel_ray.h"

namespace canopeer {
namespace {

// The i-th of `count` places on [−extent, extent], ends included.
double place(int i, int count, double extent) {
  return count == 1 ? 0.0 : extent * (2.0 * i / (count - 1) - 1.0);
}

bool in_block(const VoxelIndex& voxel, const VoxelIndex& origin) {
  return (((voxel.x() ^ origin.x()) | (voxel.y() ^ origin.y()) | (voxel.z() ^ origin.z())) &
          ~(kBlockSide - 1)) == 0;
}

// How many voxels of this walk make up `max_unknown_m`: rays cross more of them along a diagonal.
int unknown_voxels(const VoxelWalk& walk, double length_m, double max_unknown_m) {
  const double all = walk.steps + 1.0;
  return static_cast<int>(max_unknown_m < length_m ? std::ceil(all * max_unknown_m / length_m)
                                                   : all);
}

// A voxel of the caster's window in one word: 21 bits an axis, x lowest, from the window's corner.
using Packed = std::int64_t;
constexpr int kFieldBits = 21;
constexpr Packed kOneOf[3] = {1, Packed{1} << kFieldBits, Packed{1} << 2 * kFieldBits};
constexpr Packed kField = kOneOf[1] - 1;
constexpr Packed kInBlock = (kBlockSide - 1) * (kOneOf[0] + kOneOf[1] + kOneOf[2]);

std::size_t slice_of(Packed p) {
  return static_cast<std::size_t>(p >> 2 * kFieldBits & (kBlockSide - 1));
}
std::uint64_t bit_of(Packed p) {
  constexpr Packed kRow = (kBlockSide - 1) << kBlockShift;
  return std::uint64_t{1} << ((p >> (kFieldBits - kBlockShift) & kRow) | (p & (kBlockSide - 1)));
}

// A voxel walk under way.
class WalkingRay {
 public:
  WalkingRay(const VoxelWalk& walk, const VoxelIndex& corner)
      : steps_(walk.steps), x_(walk, 0), y_(walk, 1), z_(walk, 2) {
    const VoxelIndex start = walk.first - corner;
    at_ = start.x() * kOneOf[0] + start.y() * kOneOf[1] + start.z() * kOneOf[2];
  }

  [[nodiscard]] Packed at() const { return at_; }
  [[nodiscard]] bool ended() const { return steps_ < 0; }

  // To the next voxel, as walk_voxels does it: at equal times y goes before x, x before z.
  void step() {
    const auto x_before_y = -static_cast<std::int64_t>(x_.t < y_.t);
    const auto on_z = -static_cast<std::int64_t>(z_.t < std::min(x_.t, y_.t));
    const std::int64_t on_x = x_before_y & ~on_z;
    const std::int64_t on_y = ~x_before_y & ~on_z;
    at_ += (x_.move & on_x) | (y_.move & on_y) | (z_.move & on_z);
    x_.t += x_.dt & on_x;
    y_.t += y_.dt & on_y;
    z_.t += z_.dt & on_z;
    --steps_;
  }

  // All steps to the first voxel of the next block at once.
  void leave_block() {
    const std::int64_t x_out = x_.leaves_block(at_);
    const std::int64_t y_out = y_.leaves_block(at_ >> kFieldBits);
    const std::int64_t z_out = z_.leaves_block(at_ >> 2 * kFieldBits);
    const std::int64_t out = std::min({x_out, y_out, z_out});
    advance(y_, out);
    advance(x_, out == y_out ? out - 1 : out);
    advance(z_, out == y_out || out == x_out ? out - 1 : out);
  }

 private:
  struct Axis {
    Axis(const VoxelWalk& walk, int axis)
        : t(walk.t_next[axis]),
          dt(walk.t_delta[axis]),
          per_dt(dt == 0 ? 0.0 : 1.0 / static_cast<double>(dt)),
          move(walk.step[axis] * kOneOf[axis]) {}
    // When the axis crosses the border of the block its voxel (the lowest bits of `at`) is in.
    [[nodiscard]] std::int64_t leaves_block(Packed at) const {
      const auto in_block = at & (kBlockSide - 1);
      return t + (move > 0 ? kBlockSide - 1 - in_block : in_block) * dt;
    }

    std::int64_t t;   // of the next crossing
    std::int64_t dt;  // between crossings; 0: there is none
    double per_dt;
    Packed move;
  };

  // All of an axis' crossings up to time `until`.
  void advance(Axis& axis, std::int64_t until) {
    auto n = static_cast<std::int64_t>(static_cast<double>(until - axis.t) * axis.per_dt) + 1;
    n += axis.t + n * axis.dt <= until;
    n -= axis.t + (n - 1) * axis.dt > until;
    at_ += n * axis.move;
    axis.t += n * axis.dt;
    steps_ -= static_cast<int>(n);
  }

  Packed at_;
  int steps_;  // still to make; −1: the end is passed
  Axis x_, y_, z_;
};

// Collects the voxels that rays cross before the first occupied one, in a dense window of chunks.
class Caster {
 public:
  // All rays lie within `world`. `all`: known voxels are wanted too, so no block is clear.
  Caster(const VoxelMap& map, const Box& world, bool all) : map_(map), all_(all) {
    const double chunk_m = kChunkSide * kBlockSide * map.resolution_m();
    // One to spare on each side: a walk may pass its end by a voxel before it stops.
    first_block_ = (voxel_at(world.min(), chunk_m) - VoxelIndex::Ones()) * kChunkSide;
    const VoxelIndex last_block =
        (voxel_at(world.max(), chunk_m) + VoxelIndex::Ones()) * kChunkSide;
    blocks_ = last_block - first_block_ + VoxelIndex::Constant(kChunkSide);
    const auto cells = [](const VoxelIndex& size) {
      return static_cast<std::size_t>(size.cast<std::int64_t>().prod());
    };
    number_.resize(cells(blocks_));
    chunks_.reserve(cells(blocks_ / kChunkSide));
    for_each_index(blocks_ / kChunkSide, [&](int x, int y, int z) {
      chunks_.push_back(map.chunk(key_at(x * kChunkSide, y * kChunkSide, z * kChunkSide)));
    });
    crossed_.reserve(1024);
  }

  // The ray ends after crossing `max_unknown_m` of unknown space.
  void cast(const Vec3& from, const Vec3& to, double max_unknown_m);
  [[nodiscard]] ViewCast result() const;
  [[nodiscard]] SeenVoxels all() const;

 private:
  static constexpr int kChunkSide = 1 << BlockDirectory::kChunkShift;
  static constexpr std::uint32_t kNew = 0;
  static constexpr std::uint32_t kClear = 1;  // all free: nothing to find, nothing in the way
  static constexpr std::uint32_t kFirst = 2;  // of the others

  struct Crossed {
    const BlockMasks* known;    // nullptr: nothing observed there
    const VoxelMask* occupied;  // nullptr: none
    VoxelMask voxels;           // crossed before an occupied one
  };

  template <typename Visit>
  static void for_each_index(const VoxelIndex& size, Visit&& visit) {
    for (int z = 0; z < size.z(); ++z) {
      for (int y = 0; y < size.y(); ++y) {
        for (int x = 0; x < size.x(); ++x) visit(x, y, z);
      }
    }
  }
  [[nodiscard]] BlockKey key_at(int x, int y, int z) const {
    return pack_block(first_block_.x() + x, first_block_.y() + y, first_block_.z() + z);
  }
  // The block of the window that holds `p`; nullptr when it is clear.
  Crossed* enter(Packed p) {
    const auto block = [p](int axis) {
      return static_cast<int>(p >> (axis * kFieldBits) & kField) >> kBlockShift;
    };
    const int x = block(0), y = block(1), z = block(2);
    std::uint32_t& number =
        number_[static_cast<std::size_t>((z * blocks_.y() + y) * blocks_.x() + x)];
    if (number == kNew) number = number_new(x, y, z);
    return number == kClear ? nullptr : &crossed_[number - kFirst];
  }
  std::uint32_t number_new(int x, int y, int z);
  void stop_at(const Crossed* block, std::size_t slice, std::uint64_t bit) {
    const auto i = static_cast<std::size_t>(block - crossed_.data());
    if (stops_.size() <= i) stops_.resize(crossed_.size());
    stops_[i].slices[slice] |= bit;
  }
  // `visit(BlockKey, const Crossed*)` (nullptr: clear) for the blocks entered, sorted by key.
  template <typename Visit>
  void for_each_entered(Visit&& visit) const;

  const VoxelMap& map_;
  bool all_;
  std::vector<VoxelMask> stops_;  // where rays stopped, by place in crossed_; only for all_
  VoxelIndex first_block_;
  VoxelIndex blocks_;  // of the window, per axis
  std::vector<std::uint32_t>
      number_;  // per block of the window: kNew, kClear, or place in crossed_
  std::vector<const BlockDirectory::Chunk*> chunks_;
  std::vector<Crossed> crossed_;
};

std::uint32_t Caster::number_new(int x, int y, int z) {
  const VoxelIndex chunks = blocks_ / kChunkSide;
  const BlockDirectory::Chunk* chunk = chunks_[static_cast<std::size_t>(
      (z / kChunkSide * chunks.y() + y / kChunkSide) * chunks.x() + x / kChunkSide)];
  Crossed block{nullptr, nullptr, {}};
  if (chunk != nullptr) {
    const BlockKey key = key_at(x, y, z);
    const std::size_t place = BlockDirectory::place_in_chunk(key);
    if (chunk->slots[place] != BlockDirectory::kFree) {
      const unsigned summary = chunk->summaries[place];
      constexpr unsigned kRelevant = BlockSummary::kComplete | BlockSummary::kOccupied;
      if (!all_ && (summary & kRelevant) == BlockSummary::kComplete) return kClear;
      block.known = &map_.block_in_slot(chunk->slots[place]);
      if ((summary & BlockSummary::kOccupied) != 0) {
        block.occupied = &block.known->occupied;
      }
    }
  }
  crossed_.push_back(block);
  return static_cast<std::uint32_t>(crossed_.size() - 1) + kFirst;
}

void Caster::cast(const Vec3& from, const Vec3& to, double max_unknown_m) {
  const VoxelWalk walk(from, to, map_.resolution_m());
  WalkingRay ray(walk, first_block_ * kBlockSide);
  int unknown_left = unknown_voxels(walk, (to - from).norm(), max_unknown_m);
  while (!ray.ended()) {
    Crossed* block = enter(ray.at());
    const Packed here = ray.at() & ~kInBlock;
    if (block == nullptr) {
      ray.leave_block();
      continue;
    }
    do {
      const std::size_t slice = slice_of(ray.at());
      const std::uint64_t bit = bit_of(ray.at());
      if (block->occupied != nullptr && (block->occupied->slices[slice] & bit) != 0) {
        if (all_) stop_at(block, slice, bit);
        return;
      }
      block->voxels.slices[slice] |= bit;
      const bool known =
          block->known != nullptr && (block->known->observed.slices[slice] & bit) != 0;
      if (!known && --unknown_left == 0) return;
      ray.step();
    } while (!ray.ended() && (ray.at() & ~kInBlock) == here);
  }
}

// Window order is key order.
template <typename Visit>
void Caster::for_each_entered(Visit&& visit) const {
  const std::uint32_t* number = number_.data();
  for_each_index(blocks_, [&](int x, int y, int z) {
    const std::uint32_t n = *number++;
    if (n != kNew) visit(key_at(x, y, z), n == kClear ? nullptr : &crossed_[n - kFirst]);
  });
}

ViewCast Caster::result() const {
  ViewCast cast;
  cast.touched.reserve(2 * crossed_.size());
  std::vector<VoxelSet::Block> unknown;
  unknown.reserve(crossed_.size());
  for_each_entered([&](BlockKey key, const Crossed* block) {
    cast.touched.push_back(key);
    if (block == nullptr) return;
    VoxelMask voxels = block->voxels;
    if (block->known != nullptr) voxels -= block->known->observed;
    if (voxels.any()) unknown.push_back({key, voxels});
  });
  cast.unknown = VoxelSet(std::move(unknown));
  return cast;
}

SeenVoxels Caster::all() const {
  SeenVoxels seen;
  std::vector<VoxelSet::Block> unknown, free, occupied, roi;
  for_each_entered([&](BlockKey key, const Crossed* block) {
    seen.touched.push_back(key);
    VoxelMask not_known = block->voxels;
    if (block->known != nullptr) {
      not_known -= block->known->observed;
      VoxelMask known = block->voxels;
      known &= block->known->observed;
      free.push_back({key, known});
      const auto i = static_cast<std::size_t>(block - crossed_.data());
      const VoxelMask stops = i < stops_.size() ? stops_[i] : VoxelMask{};
      occupied.push_back({key, stops});
      VoxelMask fruit = block->voxels;
      fruit |= stops;
      fruit &= block->known->roi;
      roi.push_back({key, fruit});
    }
    unknown.push_back({key, not_known});
  });
  seen.unknown = VoxelSet(std::move(unknown));
  seen.free = VoxelSet(std::move(free));
  seen.occupied = VoxelSet(std::move(occupied));
  seen.roi = VoxelSet(std::move(roi));
  return seen;
}

// A caster that has cast the fan.
Caster cast_fan(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan, bool all) {
  CANOPEER_CHECK(fan.columns >= 1 && fan.rows >= 1, "a view fan has at least one ray");
  const double extent_x = std::tan(fan.fov_x_rad / 2.0);
  const double extent_y = std::tan(fan.fov_y_rad / 2.0);
  const auto end = [&](double x, double y) {
    return Vec3(T_world_camera * (fan.depth_m * Vec3(x, y, 1.0)));
  };
  const Vec3 from = T_world_camera.translation();
  Box world(from, from);
  for (const double x : {-extent_x, extent_x}) {
    for (const double y : {-extent_y, extent_y}) world.extend(end(x, y));
  }
  Caster caster(map, world, all);
  for (int row = 0; row < fan.rows; ++row) {
    for (int column = 0; column < fan.columns; ++column) {
      caster.cast(from, end(place(column, fan.columns, extent_x), place(row, fan.rows, extent_y)),
                  fan.max_unknown_m);
    }
  }
  return caster;
}

}  // namespace

ViewCast cast_view(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan) {
  return cast_fan(map, T_world_camera, fan, false).result();
}

SeenVoxels cast_view_all(const VoxelMap& map, const Pose& T_world_camera, const ViewFan& fan) {
  return cast_fan(map, T_world_camera, fan, true).all();
}

bool still_valid(const ViewCast& cast, const std::vector<BlockKey>& changed_sorted) {
  auto it = changed_sorted.begin();
  for (const BlockKey key : cast.touched) {
    it = std::lower_bound(it, changed_sorted.end(), key);
    if (it == changed_sorted.end()) return true;
    if (*it == key) return false;
  }
  return true;
}

bool still_valid(const ViewCast& cast, const VoxelMap& map, std::uint64_t version) {
  return std::all_of(cast.touched.begin(), cast.touched.end(),
                     [&](BlockKey key) { return map.block_version(key) <= version; });
}

bool ray_blocked(const VoxelMap& map, const Vec3& from, const Vec3& to, double ignore_near_from_m) {
  const double length = (to - from).norm();
  if (length <= ignore_near_from_m) return false;
  const Vec3 start =
      ignore_near_from_m > 0.0 ? Vec3(from + (to - from) * (ignore_near_from_m / length)) : from;
  const BlockMasks* masks = map.block(block_key(voxel_at(start, map.resolution_m())));
  VoxelIndex origin = block_origin(block_key(voxel_at(start, map.resolution_m())));
  return !walk_voxels(start, to, map.resolution_m(), [&](const VoxelIndex& voxel) {
    if (!in_block(voxel, origin)) {
      const BlockKey key = block_key(voxel);
      origin = block_origin(key);
      masks = map.block(key);
    }
    return masks == nullptr || !masks->occupied.test(voxel);
  });
}

}  // namespace canopeer
