#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "canopeer/base/rng.h"
#include "canopeer/map/frontier.h"
#include "canopeer/viewgraph/view_pose.h"

namespace canopeer {

/// How often each kind of frontier is looked at; the three sum to 1.
struct TargetShares {
  double roi = 0.5;
  double occupied = 0.3;
  double border = 0.2;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(roi, occupied, border);
  }
};

/// A place to look at, and what is to be found there.
struct Target {
  TargetKind kind = TargetKind::none;
  Vec3 p_world = Vec3::Zero();
};

/// Draws target positions from the frontiers of the map ([Zaenker23], section III-B). First it
/// draws a kind by its share. Then it draws a voxel centre within the kind, uniformly or with a
/// chance in proportion to its weight. A kind without voxels hands over to the next one, in the
/// order ROI, occupied, border, ROI. Const calls are thread-safe; a copy shares the targets and is
/// a cheap snapshot.
class TargetSampler {
 public:
  /// Of a target's position (world); 0 or less: never drawn.
  using Weight = std::function<double(const Vec3&)>;

  TargetSampler() = default;
  /// Without `weight` all targets weigh the same.
  TargetSampler(const FrontierTargets& targets, double resolution_m, const TargetShares& shares,
                const Weight& weight = {});

  /// No targets of this kind are drawn while it is closed.
  void close(TargetKind kind, bool closed);
  /// A kind by its share, an open one that has targets; nothing when there is none.
  [[nodiscard]] std::optional<TargetKind> draw_kind(Rng& rng) const;
  /// A target of that kind, which has some.
  [[nodiscard]] Target draw(TargetKind kind, Rng& rng) const;
  /// No open kind has targets.
  [[nodiscard]] bool empty() const;

  template <typename Archive>
  void save(Archive& archive) const {
    archive(*kinds_, resolution_m_, shares_, closed_);
  }
  template <typename Archive>
  void load(Archive& archive) {
    auto kinds = std::make_shared<Kinds>();
    archive(*kinds, resolution_m_, shares_, closed_);
    kinds_ = std::move(kinds);
  }

 private:
  struct Weighted {
    std::vector<VoxelIndex> voxels;
    std::vector<double> until;  ///< sum of the weights up to and with this one

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(voxels, until);
    }
  };
  using Kinds = std::array<Weighted, 4>;
  [[nodiscard]] const Weighted& of_kind(TargetKind kind) const {
    return (*kinds_)[static_cast<std::size_t>(kind)];
  }
  [[nodiscard]] bool available(TargetKind kind) const {
    return !closed_[static_cast<std::size_t>(kind)] && !of_kind(kind).voxels.empty();
  }

  std::shared_ptr<const Kinds> kinds_ = std::make_shared<Kinds>();
  double resolution_m_ = 0.01;
  TargetShares shares_;
  std::array<bool, 4> closed_{};  // by kind
};

}  // namespace canopeer
