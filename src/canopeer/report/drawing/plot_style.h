#pragma once

#include <string_view>

namespace canopeer {

/// CSS of every plot and map. Colours are variables, for a light and a dark page, and stay apart
/// for colour-blind readers (after Okabe & Ito). Goes into the page once, or into a stand-alone
/// SVG.
[[nodiscard]] std::string_view plot_style();

}  // namespace canopeer
