#pragma once

#include <cstdint>

#include "canopeer/base/expected.h"
#include "canopeer/import/scan_rows.h"
#include "canopeer/import/world_import.h"
#include "canopeer/scene/row_world.h"

namespace canopeer {

/// Where the world of a mission comes from: it is generated, unless one of the others is named.
struct WorldSource {
  WorldOptions generated;
  WorldImportOptions import;  ///< import.file empty: no
  ScanRowsOptions scans;      ///< scans.scans empty: no

  [[nodiscard]] bool imported() const { return !import.file.empty() || !scans.scans.empty(); }
};

/// Makes the world. `seed` is that of the generated one; an imported one is the same for all seeds.
[[nodiscard]] Expected<ImportedScene> build_world(const WorldSource& source, std::uint64_t seed,
                                                  const ImportProgressCallback& progress = {});

}  // namespace canopeer
