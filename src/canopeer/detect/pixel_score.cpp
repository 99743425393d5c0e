#include "canopeer/detect/pixel_score.h"

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

bool same_size(const Mask& a, const Mask& b) {
  return a.width() == b.width() && a.height() == b.height();
}

double share(long long part, long long whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

void PixelCounts::add(const Mask& found, const Mask& truth, const Mask* ignore) {
  CANOPEER_CHECK(same_size(found, truth), "masks of one image");
  CANOPEER_CHECK(ignore == nullptr || same_size(found, *ignore), "masks of one image");
  for (std::size_t i = 0; i < found.pixels().size(); ++i) {
    if (ignore != nullptr && ignore->pixels()[i] != 0) continue;
    const bool is_found = found.pixels()[i] != 0;
    const bool is_true = truth.pixels()[i] != 0;
    true_positives += is_found && is_true;
    false_positives += is_found && !is_true;
    false_negatives += !is_found && is_true;
  }
}

PixelScore PixelCounts::score() const {
  return {share(true_positives, true_positives + false_positives),
          share(true_positives, true_positives + false_negatives),
          share(true_positives, true_positives + false_positives + false_negatives)};
}

}  // namespace canopeer
