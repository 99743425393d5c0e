#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/map/voxel_map.h"
#include "canopeer/mission/ports.h"
#include "canopeer/ros2/trolley/trolley_driver.h"

namespace canopeer::ros {

/// The trolley, as a mission drives it: within its limits, with the arm at home, asked for where a
/// person wants to be asked.
class Ros2Trolley : public Trolley {
 public:
  /// `arm`: the trolley does not move unless that is at a home state. `on_moved` is told when the
  /// trolley has come to a stop. All parts outlive it.
  [[nodiscard]] static Expected<std::unique_ptr<Ros2Trolley>> make(const TrolleyParts& parts,
                                                                   const Arm& arm,
                                                                   const Ros2Settings& settings,
                                                                   std::function<void()> on_moved);

  [[nodiscard]] TrolleyState state() const override { return parts_.sense.now(); }
  [[nodiscard]] Expected<void> move_to(const TrolleyState& goal) override;
  /// A parked arm may be where it keeps to the aisle (keeps_to_aisle()).
  [[nodiscard]] Expected<double> set_out(const Drive& drive) override;
  [[nodiscard]] Expected<void> arrive() override;
  [[nodiscard]] bool knows_where_it_drives() const override {
    return parts_.sense.measures_travel();
  }
  /// What it needs and does not find, for people.
  [[nodiscard]] std::vector<std::string> missing() const { return driver_->missing(); }

  /// After a push by hand, until check_place().
  [[nodiscard]] bool in_doubt() const { return driver_->in_doubt(); }
  /// The first frame after a push by hand: held against the map, its pose and the trolley's place
  /// put right where the map is clear, and people told. Other frames are left alone.
  /// Where the map is unclear a person confirms the place once more; that is waited for.
  [[nodiscard]] Expected<void> check_place(const VoxelMap* map, RgbdFrame& frame);

 private:
  Ros2Trolley(const TrolleyParts& parts, const Arm& arm, const Ros2Settings& settings,
              std::unique_ptr<TrolleyDriver> driver, std::function<void()> on_moved)
      : parts_(parts),
        arm_(arm),
        settings_(settings.trolley),
        dry_run_(settings.dry_run),
        driver_(std::move(driver)),
        on_moved_(std::move(on_moved)) {}
  [[nodiscard]] Expected<void> check_limits(const TrolleyState& goal) const;
  [[nodiscard]] Expected<void> check_arm(bool parked) const;

  TrolleyParts parts_;
  const Arm& arm_;
  const Ros2TrolleySettings settings_;
  const bool dry_run_;
  std::unique_ptr<TrolleyDriver> driver_;
  std::function<void()> on_moved_;
  bool under_way_ = false;
};

}  // namespace canopeer::ros
