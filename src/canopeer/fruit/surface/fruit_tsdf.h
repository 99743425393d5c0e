#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/fruit/surface/frame_depths.h"
#include "canopeer/geometry/voxel_ray.h"
#include "canopeer/sensing/image.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer {

inline constexpr int kPixelLabels = 4;  ///< values of PixelLabel

/// Voxels of the fruit surface, and which pixels carve it.
struct TsdfOptions {
  double voxel_m = 0.004;           ///< Marangoz et al., CASE 2022
  double truncation_m = 0.012;      ///< distances are kept up to here, in front and behind
  double max_range_m = 1.6;         ///< farther pixels (depth along the axis) are not taken
  double max_depth_step_m = 0.012;  ///< a pixel beside a larger step is at an edge and not taken
  double max_weight = 40.0;   ///< of a voxel, in frames from 0.5 m: older ones fade when it is full
  double changed_m = 0.0004;  ///< a surface that moved less has not changed

  friend bool operator==(const TsdfOptions&, const TsdfOptions&) = default;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(voxel_m, truncation_m, max_range_m, max_depth_step_m, max_weight, changed_m);
  }

  [[nodiscard]] Expected<void> validate() const;
};

/// Who saw the surface near a voxel, and how it looks there.
struct TsdfLooks {
  std::array<float, 3> color{};
  float color_weight = 0.0F;
  std::array<float, kPixelLabels> votes{};  ///< pixels near the surface, by class

  friend bool operator==(const TsdfLooks&, const TsdfLooks&) = default;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(color, color_weight, votes);
  }
};

/// Truncated signed distances around fruits (Curless & Levoy 1996; Newcombe et al. 2011), with
/// colour and class votes. Only blocks of 8³ voxels near fruit pixels exist. Every pixel with depth
/// that looks through them is taken in: fruit or not, it tells where the surface is and where there
/// is none (carving). Deterministic; one owner.
class FruitTsdf {
 public:
  static constexpr int kSide = 8;
  static constexpr int kVoxels = kSide * kSide * kSide;
  static constexpr float kSeenWeight = 0.1F;  ///< about one frame from 1.5 m
  /// 8³ voxels.
  struct Block {
    VoxelIndex index = VoxelIndex::Zero();  ///< in blocks
    // Of each voxel (see offset()) the truncated signed distance, positive outside, and how much it
    // is sure of; 0: never seen. Apart from the rest, since most voxels are looked at for no more.
    std::array<float, kVoxels> distance_m{};
    std::array<float, kVoxels> weight{};
    std::array<TsdfLooks, kVoxels> looks;
    /// By row along x (y + 8 z), bit x: weight is at least kSeenWeight; distance is negative.
    std::array<std::uint8_t, kSide * kSide> seen{};
    std::array<std::uint8_t, kSide * kSide> inside{};
    /// Which blocks' surface has changed since take_changed(). Bit 0 is this block. Bit k is the
    /// block below by 1 along x (k & 1), y (k & 2), z (k & 4), whose upper cells have corners here.
    std::uint8_t changed = 0;
    int fruit_frame = -1;  ///< number of the last frame with a fruit pixel in it
    /// Numbers of the 27 blocks around and with this one, x fastest; −1: there is none.
    std::array<int, 27> around{};

    /// All but `around`; of the looks only those that there are: most voxels have none.
    template <typename Archive>
    void serialize(Archive& archive) {
      archive(index, distance_m, weight, seen, inside, changed, fruit_frame);
      auto looked_at = rows_with_looks();
      archive(looked_at);
      for (std::size_t i = 0; i < looks.size(); ++i) {
        if ((looked_at[i / kSide] >> i % kSide & 1) != 0) archive(looks[i]);
      }
    }
    /// By row along x, bit x: the voxel has looks.
    [[nodiscard]] std::array<std::uint8_t, kSide * kSide> rows_with_looks() const;
  };

  explicit FruitTsdf(const TsdfOptions& options);

  /// `classes`: PixelLabel of each pixel as a number, of the frame's size. Blocks are numbered in
  /// the order first seen.
  void add(const RgbdFrame& frame, const Image<std::uint8_t>& classes);

  /// Numbers of the blocks whose surface has changed, ascending, each once; forgets the changes.
  std::vector<int> take_changed();

  /// −1: there is none.
  [[nodiscard]] int block_at(const VoxelIndex& block) const;
  /// Truncated signed distance at a voxel; none where nobody has looked.
  [[nodiscard]] std::optional<float> distance_at(const VoxelIndex& voxel) const;
  [[nodiscard]] const std::deque<Block>& blocks() const { return blocks_; }
  /// Blocks that the last frame's fruit pixels lie in or beside.
  [[nodiscard]] const std::vector<int>& seen_in_last_frame() const { return seen_; }
  [[nodiscard]] int frames() const { return frames_; }
  [[nodiscard]] const TsdfOptions& options() const { return options_; }

  /// Written: every block, how many frames there were, what the last one saw. Not written: whatever
  /// add() sets before it looks at it (depths of the frame), and what relink() tells anew.
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(blocks_, seen_, frames_);
  }
  /// After reading: which blocks are where and beside which; nothing but their indices says so.
  /// False: that makes no sense.
  [[nodiscard]] bool relink();

  static std::size_t offset(int x, int y, int z) {
    return static_cast<std::size_t>(x + kSide * (y + kSide * z));
  }

 private:
  void allocate(const RgbdFrame& frame, const Image<std::uint8_t>& classes);
  int make_block(const VoxelIndex& index);
  void link(int number);

  TsdfOptions options_;
  std::deque<Block> blocks_;
  std::unordered_map<std::uint64_t, int> number_of_;  // never iterated
  std::vector<int> seen_;
  FrameDepths depths_;  // of the last frame
  int frames_ = 0;
};

}  // namespace canopeer
