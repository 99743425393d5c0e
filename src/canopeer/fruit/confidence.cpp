#include "canopeer/fruit/confidence.h"

#include <algorithm>
#include <cmath>

namespace canopeer {

ConfidenceModel::ConfidenceModel() {
  // 1, log area, share seen, misfit, fruit pixels, log views, size, curvature; see decision 0084.
  weights << 5.384, 4.662, 3.043, -4.584, 1.117, -1.324, -0.720, -0.997;
}

ConfidenceModel::Features ConfidenceModel::features(const FruitEvidence& e) {
  Features f;
  f << 1.0, std::log(std::max(e.area_cm2, 0.1) / 10.0), e.seen_share,
      std::min(e.rms_m, 0.02) / 0.003, e.fruit_share, std::log(std::max(e.views, 1)),
      std::min(e.size_sds, 10.0), std::min(e.normal_spread, 1.0) / 0.25;
  return f;
}

double ConfidenceModel::operator()(const FruitEvidence& evidence) const {
  return 1.0 / (1.0 + std::exp(-weights.dot(features(evidence))));
}

}  // namespace canopeer
