#pragma once

#include <optional>
#include <span>
#include <vector>

namespace canopeer {

/// Ranks from 1, ties share the mean of theirs.
[[nodiscard]] std::vector<double> ranks_of(std::span<const double> values);

/// Spearman's rank correlation of `a` and `b`, which are of the same length; nothing for fewer than
/// three pairs or a constant sample.
[[nodiscard]] std::optional<double> rank_correlation(std::span<const double> a,
                                                     std::span<const double> b);

}  // namespace canopeer
