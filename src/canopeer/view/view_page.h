#pragma once

#include <string_view>

namespace canopeer {

/// The page as one HTML file, as built from web/; empty: built without Node.
[[nodiscard]] std::string_view view_page();

}  // namespace canopeer
