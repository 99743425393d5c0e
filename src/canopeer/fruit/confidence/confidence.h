#pragma once

#include <Eigen/Core>

namespace canopeer {

/// What tells how likely a candidate is a fruit.
struct FruitEvidence {
  double area_cm2 = 0.0;       ///< of the surface seen
  double seen_share = 0.0;     ///< of the fitted shape's surface
  double rms_m = 0.0;          ///< of the points about the shape
  double size_sds = 0.0;       ///< how far its size is from the prior's, standard deviations
  double normal_spread = 0.0;  ///< variance of the normals: 0 for a plane
  double foreign_share = 0.0;  ///< of the surface that fits the shape what is taken for no fruit
  double free_share = 0.0;     ///< of the shape's surface what lies where cameras saw nothing
  // What does not count by itself (decision 0086), for whoever fits another model.
  double fruit_share = 0.0;  ///< of the pixels on it those taken for fruit
  int views = 0;             ///< frames it was seen in

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(area_cm2, seen_share, rms_m, size_sds, normal_spread, foreign_share, free_share,
            fruit_share, views);
  }
};

/// Logistic regression on the evidence: log-odds that add up. For a fruit, never against it: more
/// area, more of the shape, more curvature. Against a fruit, never for it: misfit, an odd size,
/// surface that goes on as something else, shape where there is nothing. The weights were fitted on
/// simulated runs. docs/decisions/0086 says how, and how well they hold on others.
struct ConfidenceModel {
  static constexpr int kFeatures = 8;
  using Features = Eigen::Matrix<double, kFeatures, 1>;
  Features weights;

  ConfidenceModel();
  [[nodiscard]] static Features features(const FruitEvidence& evidence);
  /// Probability that the candidate is a fruit, 0 … 1.
  [[nodiscard]] double operator()(const FruitEvidence& evidence) const;
};

}  // namespace canopeer
