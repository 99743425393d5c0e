#pragma once

#include "canopeer/import/sdf/sdf_includes.h"
#include "canopeer/import/sdf/sdf_scope.h"

namespace canopeer {

/// All models of a world, each in its place.
struct SdfTree {
  std::unique_ptr<SdfScope> world;
  bool lacks_ground = false;  ///< it includes model://ground_plane, which is not there
  std::vector<std::string> notices;
};

/// Models, what they include, and populations of them. `world` is a <world>, or another element
/// that holds models. `model://sun` and `model://ground_plane` need not be there. What has no shape
/// is passed over; roads, actors and robots are named in notices. Error: file and line; includes
/// that go round in a circle are one, too.
[[nodiscard]] Expected<SdfTree> read_sdf_tree(const SdfElement& world, SdfIncludes& includes);

}  // namespace canopeer
