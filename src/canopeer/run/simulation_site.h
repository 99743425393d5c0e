#pragma once

#include <memory>

#include "canopeer/run/site.h"

namespace canopeer {

/// The world the mission names, generated or imported, with the simulated robot in it at the first
/// segment's home. Notices tell what an import left out.
[[nodiscard]] Expected<std::unique_ptr<Site>> make_simulation_site(const SiteRequest& request);

/// build_world(), and what it did and left out said to `tell`. With a `detector` by colour also
/// whether that can see the fruits at all; null: there is none.
[[nodiscard]] Expected<ImportedScene> build_world_saying(const WorldSource& source,
                                                         std::uint64_t seed,
                                                         const SiteCallbacks& tell,
                                                         const DetectorOptions* detector);

}  // namespace canopeer
