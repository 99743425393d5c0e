#pragma once

#include <cstdint>
#include <vector>

#include "canopeer/bounds/view_pool.h"

namespace canopeer {

/// A set of fruits by number.
class FruitSet {
 public:
  explicit FruitSet(std::size_t fruits = 0) : words_((fruits + 63) / 64) {}
  void add(std::size_t fruit) { words_[fruit / 64] |= std::uint64_t{1} << (fruit % 64); }
  [[nodiscard]] bool has(std::size_t fruit) const {
    return ((words_[fruit / 64] >> (fruit % 64)) & 1U) != 0;
  }
  /// Adds what is in `a` but not in `b`.
  void add_difference(const FruitSet& a, const FruitSet& b) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= a.words_[i] & ~b.words_[i];
  }
  void add(const FruitSet& other) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= other.words_[i];
  }
  [[nodiscard]] bool within(const FruitSet& other) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if ((words_[i] & ~other.words_[i]) != 0) return false;
    }
    return true;
  }
  [[nodiscard]] bool empty() const;
  [[nodiscard]] int size() const;
  /// How many of `other` are not in it.
  [[nodiscard]] int lacks(const FruitSet& other) const;

 private:
  std::vector<std::uint64_t> words_;
};

/// What a view alone shows of each fruit, as a share of what finding it takes (FindRule): 1 and no
/// more when it shows enough.
struct ViewFruits {
  FruitSet any;              ///< of which it shows something
  FruitSet found;            ///< of which it shows enough
  std::vector<float> share;  ///< by fruit
};

/// Fruits of a pool, numbered 0 … count − 1 in the order of their ids.
struct PoolFruits {
  int count = 0;  ///< that any patch is of
  std::vector<int> of_patch;
  double enough_cm2 = 0.0;  ///< 0: any patch is

  [[nodiscard]] ViewFruits seen_by(const FruitPatches& patches, const PoolView& view) const;
};
[[nodiscard]] PoolFruits pool_fruits(const FruitPatches& patches, const FindRule& rule);

}  // namespace canopeer
