#pragma once

#include <optional>
#include <vector>

#include "canopeer/campaign/comparison.h"
#include "canopeer/report/svg_plot.h"

namespace canopeer {

/// Fruits found (0.20 m) over the time in segments: per contestant the mean over its runs, with a
/// band of one standard deviation. The published comparison has the same figure.
[[nodiscard]] SvgPlot found_plot(const Match& match);

/// Times between views of all runs, a box per contestant; the published comparison's other figure.
[[nodiscard]] SvgPlot interval_plot(const Match& match);

/// Predicted against realised gain of views, at most some hundred a contestant; nothing when nobody
/// predicts.
[[nodiscard]] std::optional<SvgPlot> gain_plot(const Match& match);

/// Fruits found at the end over the budget per segment; nothing for fewer than two budgets.
/// `matches` are those of one mission.
[[nodiscard]] std::optional<SvgPlot> budget_plot(const std::vector<const Match*>& matches);

}  // namespace canopeer
