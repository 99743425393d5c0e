#pragma once

#include <string>
#include <vector>

#include "canopeer/report/svg_plot.h"

namespace canopeer {

/// A titled part of the page; empty content gives nothing.
[[nodiscard]] std::string html_section(const std::string& title, const std::string& content);

/// The plot drawn twice, for a wide and for a narrow screen; the page's style shows one of them.
[[nodiscard]] std::string html_plot(const SvgPlot& plot, int wide_height_px, int narrow_height_px);

/// Cells are HTML. The first column is text, the others are numbers and stand right-aligned.
/// Scrolls sideways on a narrow screen.
[[nodiscard]] std::string html_table(const std::vector<std::string>& head,
                                     const std::vector<std::vector<std::string>>& rows);

/// A part that is closed until the reader opens it.
[[nodiscard]] std::string html_details(const std::string& summary, const std::string& content);

/// `html` as a link to the moment in the replay, where `canopeer view` shows it.
[[nodiscard]] std::string html_moment(double t_s, const std::string& html);

/// The whole document around `body`.
[[nodiscard]] std::string html_page(const std::string& title, const std::string& body);

}  // namespace canopeer
