#include "canopeer/bounds/limits/pool_fruits.h"

#include <algorithm>
#include <bit>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

constexpr double kRounded = 1e-5;  // of sums of areas: who is that near has enough

}  // namespace

bool FruitSet::empty() const {
  return std::all_of(words_.begin(), words_.end(), [](std::uint64_t word) { return word == 0; });
}

int FruitSet::size() const {
  int count = 0;
  for (const std::uint64_t word : words_) count += std::popcount(word);
  return count;
}

int FruitSet::lacks(const FruitSet& other) const {
  int count = 0;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    count += std::popcount(other.words_[i] & ~words_[i]);
  }
  return count;
}

PoolFruits pool_fruits(const FruitPatches& patches, const FindRule& rule) {
  CANOPEER_CHECK(patches.fruit.size() == patches.area_cm2.size(), "an area a patch");
  std::vector<int> ids = patches.fruit;
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  PoolFruits fruits;
  fruits.count = static_cast<int>(ids.size());
  fruits.enough_cm2 = std::max(0.0, rule.min_area_cm2) * (1.0 - kRounded);
  fruits.of_patch.reserve(patches.fruit.size());
  for (const int id : patches.fruit) {
    fruits.of_patch.push_back(
        static_cast<int>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()));
  }
  return fruits;
}

ViewFruits PoolFruits::seen_by(const FruitPatches& patches, const PoolView& view) const {
  const auto size = static_cast<std::size_t>(count);
  ViewFruits seen{FruitSet(size), FruitSet(size), std::vector<float>(size, 0.0F)};
  std::vector<double> area_cm2(size, 0.0);
  for (const std::uint32_t patch : view.patches) {
    const auto fruit = static_cast<std::size_t>(of_patch[patch]);
    area_cm2[fruit] += patches.area_cm2[patch];
    seen.any.add(fruit);
  }
  for (std::size_t f = 0; f < size; ++f) {
    if (!seen.any.has(f)) continue;
    if (area_cm2[f] >= enough_cm2) seen.found.add(f);
    seen.share[f] =
        seen.found.has(f) ? 1.0F : static_cast<float>((1.0 + kRounded) * area_cm2[f] / enough_cm2);
  }
  return seen;
}

}  // namespace canopeer
