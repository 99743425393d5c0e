#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "canopeer/base/compute_cost.h"
#include "canopeer/base/expected.h"

namespace canopeer {

/// Reads a table of seconds per unit of work: one key per kind (work_name), all required but
/// fruit_frame and simplex_row (0), ≥ 0.
/// "free" needs no file: see CostTable's default.
[[nodiscard]] Expected<CostTable> load_cost_table(const std::filesystem::path& path);

/// The table as such a file, `comment` (one line) first.
[[nodiscard]] std::string cost_table_text(const CostTable& table, std::string_view comment);

}  // namespace canopeer
