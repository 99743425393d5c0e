#include "canopeer/fruit/confidence/confidence.h"

#include <algorithm>
#include <cmath>

namespace canopeer {

ConfidenceModel::ConfidenceModel() {
  // By scripts/fit_confidence.py from candidates of bench/fruit_replay; see decision 0086.
  weights << 1.397, 1.048, 11.509, -8.355, -1.558, 2.362, -4.515, -17.725;
}

ConfidenceModel::Features ConfidenceModel::features(const FruitEvidence& e) {
  Features f;
  // 1, log area, share seen, misfit, size, curvature, foreign surface, free space.
  f << 1.0, std::log(std::max(e.area_cm2, 0.1) / 10.0), e.seen_share,
      std::min(e.rms_m, 0.02) / 0.003, std::min(e.size_sds, 10.0),
      std::min(e.normal_spread, 1.0) / 0.25, e.foreign_share, e.free_share;
  return f;
}

double ConfidenceModel::operator()(const FruitEvidence& evidence) const {
  return 1.0 / (1.0 + std::exp(-weights.dot(features(evidence))));
}

}  // namespace canopeer
