#include "canopeer/eval/matching.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "canopeer/eval/assignment.h"

namespace canopeer {
namespace {

/// Pairs within reach, by estimate, then truth.
std::vector<FruitPair> candidates(std::span<const Vec3> centres, const std::vector<int>& estimates,
                                  std::span<const FruitTruth> truth, bool counted,
                                  double max_distance_m) {
  std::vector<FruitPair> pairs;
  for (const int e : estimates) {
    for (std::size_t t = 0; t < truth.size(); ++t) {
      if (truth[t].counted != counted) continue;
      const double distance = (centres[static_cast<std::size_t>(e)] - truth[t].centre).norm();
      if (distance <= max_distance_m) pairs.push_back({e, static_cast<int>(t), distance});
    }
  }
  return pairs;
}

std::vector<FruitPair> closest_first(std::vector<FruitPair> pairs, std::size_t estimates,
                                     std::size_t truths) {
  std::sort(pairs.begin(), pairs.end(), [](const FruitPair& a, const FruitPair& b) {
    return std::tie(a.distance_m, a.estimate, a.truth) <
           std::tie(b.distance_m, b.estimate, b.truth);
  });
  std::vector<char> estimate_used(estimates, 0);
  std::vector<char> truth_used(truths, 0);
  std::vector<FruitPair> chosen;
  for (const FruitPair& pair : pairs) {
    char& e = estimate_used[static_cast<std::size_t>(pair.estimate)];
    char& t = truth_used[static_cast<std::size_t>(pair.truth)];
    if (e != 0 || t != 0) continue;
    e = t = 1;
    chosen.push_back(pair);
  }
  return chosen;
}

/// Pairs that share an estimate or a truth, directly or through others, form one piece; pieces are
/// independent assignment problems, and small ones when fruits are farther apart than the reach.
std::vector<std::vector<FruitPair>> independent_pieces(const std::vector<FruitPair>& pairs,
                                                       std::size_t estimates, std::size_t truths) {
  std::vector<int> parent(estimates + truths);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
    return i;
  };
  const int first_truth = static_cast<int>(estimates);
  for (const FruitPair& pair : pairs) {
    const int a = root(pair.estimate);
    const int b = root(first_truth + pair.truth);
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  std::vector<int> piece_of_root(parent.size(), -1);
  std::vector<std::vector<FruitPair>> pieces;
  for (const FruitPair& pair : pairs) {
    int& piece = piece_of_root[static_cast<std::size_t>(root(pair.estimate))];
    if (piece < 0) {
      piece = static_cast<int>(pieces.size());
      pieces.emplace_back();
    }
    pieces[static_cast<std::size_t>(piece)].push_back(pair);
  }
  return pieces;
}

std::vector<int> distinct(const std::vector<FruitPair>& pairs, int FruitPair::*member) {
  std::vector<int> values;
  for (const FruitPair& pair : pairs) values.push_back(pair.*member);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

int position(const std::vector<int>& sorted, int value) {
  return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

/// Most pairs, then least total distance. Each row has a column of its own for "unpaired" at a cost
/// above any sum of distances, so one pair more always pays.
void assign_piece(const std::vector<FruitPair>& piece, double max_distance_m,
                  std::vector<FruitPair>& chosen) {
  const std::vector<int> estimates = distinct(piece, &FruitPair::estimate);
  const std::vector<int> truths = distinct(piece, &FruitPair::truth);
  const int rows = static_cast<int>(estimates.size());
  const int real = static_cast<int>(truths.size());
  const double unpaired = (rows + 1) * (max_distance_m + 1e-9);
  const double forbidden = 2.0 * rows * unpaired + unpaired;
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(rows, real + rows, forbidden);
  for (int r = 0; r < rows; ++r) cost(r, real + r) = unpaired;
  for (const FruitPair& pair : piece) {
    cost(position(estimates, pair.estimate), position(truths, pair.truth)) = pair.distance_m;
  }
  const std::vector<int> column_of = least_cost_assignment(cost);
  for (int r = 0; r < rows; ++r) {
    const int c = column_of[r];
    if (c < real) chosen.push_back({estimates[r], truths[c], cost(r, c)});
  }
}

std::vector<FruitPair> optimal(const std::vector<FruitPair>& pairs, std::size_t estimates,
                               std::size_t truths, double max_distance_m) {
  std::vector<FruitPair> chosen;
  for (const auto& piece : independent_pieces(pairs, estimates, truths)) {
    assign_piece(piece, max_distance_m, chosen);
  }
  return chosen;
}

std::vector<int> without(const std::vector<int>& estimates, const std::vector<FruitPair>& pairs) {
  const std::vector<int> used = distinct(pairs, &FruitPair::estimate);
  std::vector<int> rest;
  std::set_difference(estimates.begin(), estimates.end(), used.begin(), used.end(),
                      std::back_inserter(rest));
  return rest;
}

/// Counted fruits first, then the rest of the estimates against the uncounted ones.
template <typename Pairing>
FruitMatching match(std::span<const Vec3> centres, std::span<const FruitTruth> truth,
                    double max_distance_m, const Pairing& pairing) {
  std::vector<int> all(centres.size());
  std::iota(all.begin(), all.end(), 0);
  FruitMatching matching;
  matching.pairs = pairing(candidates(centres, all, truth, true, max_distance_m));
  std::sort(matching.pairs.begin(), matching.pairs.end(),
            [](const FruitPair& a, const FruitPair& b) { return a.estimate < b.estimate; });
  const std::vector<int> rest = without(all, matching.pairs);
  const auto uncounted = pairing(candidates(centres, rest, truth, false, max_distance_m));
  matching.ignored = static_cast<int>(uncounted.size());
  matching.false_positives = static_cast<int>(rest.size()) - matching.ignored;
  return matching;
}

}  // namespace

FruitMatching match_greedy(std::span<const Vec3> centres, std::span<const FruitTruth> truth,
                           double max_distance_m) {
  return match(centres, truth, max_distance_m, [&](std::vector<FruitPair> pairs) {
    return closest_first(std::move(pairs), centres.size(), truth.size());
  });
}

FruitMatching match_optimal(std::span<const Vec3> centres, std::span<const FruitTruth> truth,
                            double max_distance_m) {
  return match(centres, truth, max_distance_m, [&](const std::vector<FruitPair>& pairs) {
    return optimal(pairs, centres.size(), truth.size(), max_distance_m);
  });
}

}  // namespace canopeer
