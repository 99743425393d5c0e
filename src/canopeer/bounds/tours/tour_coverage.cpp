#include "canopeer/bounds/tours/tour_coverage.h"

#include <algorithm>

namespace canopeer {
namespace {

constexpr double kJustFound = 0.88;  // of a fruit's worth
constexpr double kRobust = 0.1;      // what more of it, up to 1.5 times the least area, adds
constexpr double kByArea = 0.02;     // evenly up to the largest area that counts
constexpr double kRobustFactor = 1.5;
constexpr double kMostFactor = 4.0;

}  // namespace

TourCoverage::TourCoverage(const TourProblem& problem)
    : problem_(&problem),
      seen_((problem.patch_cm2.size() + 63) / 64, 0),
      area_cm2_(static_cast<std::size_t>(problem.fruits), 0.0) {}

double TourCoverage::worth(int fruit, double area_cm2) const {
  const double share = area_cm2 / least_cm2(fruit);
  double sum = kByArea * std::min(1.0, share / kMostFactor);
  if (share >= 1.0) {
    sum += kJustFound + kRobust * std::min(1.0, (share - 1.0) / (kRobustFactor - 1.0));
  }
  return sum;
}

double TourCoverage::new_area(const TourView& view, const FruitPart& part) const {
  if (area_cm2_[static_cast<std::size_t>(part.fruit)] == 0.0) return part.area_cm2;
  double area = 0.0;
  for (std::uint32_t i = part.first; i < part.last; ++i) {
    const std::uint32_t patch = view.patches[i];
    if (((seen_[patch / 64] >> (patch % 64)) & 1U) == 0) area += problem_->patch_cm2[patch];
  }
  return area;
}

double TourCoverage::gain(const TourView& view, double weight, const double* later) const {
  double sum = 0.0;
  for (const FruitPart& part : view.parts) {
    const double before = area_cm2_[static_cast<std::size_t>(part.fruit)];
    if (before >= kMostFactor * least_cm2(part.fruit)) continue;
    const double each = weight - (later == nullptr ? 0.0 : later[part.fruit]);
    if (each <= 0.0) continue;
    sum += each * (worth(part.fruit, before + new_area(view, part)) - worth(part.fruit, before));
  }
  return sum;
}

double TourCoverage::add(const TourView& view) {
  double sum = 0.0;
  for (const FruitPart& part : view.parts) {
    double& area = area_cm2_[static_cast<std::size_t>(part.fruit)];
    if (area >= kMostFactor * least_cm2(part.fruit)) continue;  // more of it adds nothing
    const double more = new_area(view, part);
    sum += worth(part.fruit, area + more) - worth(part.fruit, area);
    area += more;
    for (std::uint32_t i = part.first; i < part.last; ++i) {
      seen_[view.patches[i] / 64] |= std::uint64_t{1} << (view.patches[i] % 64);
    }
  }
  return sum;
}

}  // namespace canopeer
