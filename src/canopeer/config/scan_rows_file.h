#pragma once

#include <filesystem>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/import/scan_rows.h"

namespace canopeer {

/// Whether a path looks like a scene file: .yaml or .yml.
[[nodiscard]] bool is_scan_rows_file(const std::filesystem::path& path);

/// Reads a scene file: scanned plants and where they stand; keys are in docs/formats.md, paths
/// relative to the file. Errors name file, line and key.
[[nodiscard]] Expected<ScanRowsOptions> load_scan_rows(const std::filesystem::path& path);

/// The same from text; `name` stands for the file.
[[nodiscard]] Expected<ScanRowsOptions> parse_scan_rows(std::string_view text,
                                                        const std::string& name);

}  // namespace canopeer
