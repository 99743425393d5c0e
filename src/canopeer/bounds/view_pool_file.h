#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"
#include "canopeer/bounds/view_pool.h"

namespace canopeer {

/// Compressed and checksummed; the whole file or none. The same pool, the same bytes.
[[nodiscard]] Expected<void> write_view_pool(const std::filesystem::path& path,
                                             const ViewPool& pool);

/// The error names the file and says what is wrong: no pool, another version, damaged.
[[nodiscard]] Expected<ViewPool> read_view_pool(const std::filesystem::path& path);

}  // namespace canopeer
