#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/bounds/tours/tour_problem.h"

namespace canopeer {

/// What has been seen so far of each fruit, and what that is worth.
///
/// A fruit of which its `min_area_cm2` was seen is found. Since a real frame shows a little more or
/// less than was reckoned, the last tenth of its worth is for half as much again, and a fiftieth
/// grows with the area up to four times as much: finds that are robust, where they are cheap.
class TourCoverage {
 public:
  explicit TourCoverage(const TourProblem& problem);

  /// Of a fruit of which so much is seen, 0 … 1.
  [[nodiscard]] double worth(int fruit, double area_cm2) const;
  /// What the view would add, each fruit's worth times `weight` less what others will make of it
  /// (`later`, by fruit, may be null); never less than 0 a fruit.
  [[nodiscard]] double gain(const TourView& view, double weight, const double* later) const;
  /// Takes the view; returns the sum of worths it adds.
  double add(const TourView& view);

  [[nodiscard]] bool found(int fruit) const {
    return area_cm2_[static_cast<std::size_t>(fruit)] >= least_cm2(fruit);
  }
  /// Up to what counts.
  [[nodiscard]] double area_cm2(int fruit) const {
    return area_cm2_[static_cast<std::size_t>(fruit)];
  }

 private:
  [[nodiscard]] double least_cm2(int fruit) const {
    return problem_->min_area_cm2[static_cast<std::size_t>(fruit)];
  }
  [[nodiscard]] double new_area(const TourView& view, const FruitPart& part) const;

  const TourProblem* problem_;
  std::vector<std::uint64_t> seen_;  ///< a bit a patch
  std::vector<double> area_cm2_;     ///< by fruit
};

}  // namespace canopeer
