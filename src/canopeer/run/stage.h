#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "canopeer/mission/robot_kit.h"
#include "canopeer/run/run_registries.h"

namespace canopeer {

/// What to run: a mission file and what the command line says on top. Where settings are made by
/// hand (MissionFile), the first three are not looked at.
struct StageRequest {
  std::filesystem::path mission;
  Overrides overrides;                              ///< settings in place of the file's
  std::vector<std::filesystem::path> table_dirs;    ///< where compute tables are found by name
  std::vector<std::filesystem::path> package_path;  ///< where packages of robots' meshes are too
  std::vector<std::filesystem::path> fuel_caches;   ///< see WorldImportOptions; empty: the file's
  std::string site = "simulation";
  bool realtime = false;  ///< on the wall clock; sites of real robots are so anyway
  int threads = 0;        ///< at most; 0: all cores
  SiteCallbacks callbacks{};
};

/// The place a mission works in: its settings, the robot, and what stands behind the ports. Makes
/// sure that they fit each other before anything moves.
class Stage {
 public:
  /// The error is about the mission's files (file, line and key), or about what does not fit.
  [[nodiscard]] static Expected<std::unique_ptr<Stage>> make(const StageRequest& request,
                                                             const RunRegistries& registries);
  /// The same from settings made by hand.
  [[nodiscard]] static Expected<std::unique_ptr<Stage>> make(MissionFile file,
                                                             const StageRequest& request,
                                                             const RunRegistries& registries);

  [[nodiscard]] const MissionFile& file() const { return file_; }
  [[nodiscard]] const RunRegistries& registries() const { return registries_; }
  [[nodiscard]] RobotKit robot() const { return {robot_, ik_, site_->judge()}; }
  [[nodiscard]] Site& site() { return *site_; }

 private:
  Stage(MissionFile file, RobotModel robot, ArmIk ik, const RunRegistries& registries);

  MissionFile file_;
  RobotModel robot_;
  ArmIk ik_;
  RunRegistries registries_;
  std::unique_ptr<Site> site_;
};

}  // namespace canopeer
