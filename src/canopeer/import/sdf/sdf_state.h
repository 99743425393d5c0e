#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/import/sdf/sdf_element.h"

namespace canopeer {

/// What an SDF <state> block says of where things are: Gazebo saves it with a world and follows it
/// rather than the models' own poses.
struct SdfState {
  struct Entry {
    std::optional<Pose> T_world;  ///< poses in <state> are in the world frame, links' too
    Vec3 scale = Vec3::Ones();
  };
  std::map<std::string, Entry> models;  ///< by full name, "row::plant_3"
  std::map<std::string, Entry> links;   ///< by full name, "row::plant_3::link"
  std::set<std::string> deleted;        ///< models that were taken out
  std::vector<SdfElement> insertions;   ///< elements that hold the models that were put in

  [[nodiscard]] const Entry* model(const std::string& name) const;
  [[nodiscard]] const Entry* link(const std::string& name) const;
};

/// Of a <world> without a <state>: empty. Error: file, line, and what is no pose or scale there.
[[nodiscard]] Expected<SdfState> read_sdf_state(const SdfElement& world);

}  // namespace canopeer
