#pragma once

#include <string>
#include <string_view>

namespace canopeer {

/// Text as content or attribute value of HTML and SVG.
[[nodiscard]] std::string escape_html(std::string_view text);

/// "48.2 s", "8 min 20 s", "2 h 05 min".
[[nodiscard]] std::string duration_text(double seconds);

/// Digits in groups of three with thin spaces between: "1 234 567".
[[nodiscard]] std::string count_text(long long count);

}  // namespace canopeer
