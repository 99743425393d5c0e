#pragma once

#include <string_view>

namespace canopeer {

/// CSS of the report page, on top of plot_style().
[[nodiscard]] std::string_view page_style();

}  // namespace canopeer
