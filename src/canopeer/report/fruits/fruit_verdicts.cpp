#include "canopeer/report/fruits/fruit_verdicts.h"

#include "canopeer/eval/matching.h"

namespace canopeer {
namespace {

std::vector<FruitTruth> uncounted(const std::vector<FruitTruth>& truth) {
  std::vector<FruitTruth> others;
  for (const FruitTruth& fruit : truth) {
    if (!fruit.counted) others.push_back(fruit);
  }
  for (FruitTruth& fruit : others) fruit.counted = true;  // to be matched like any other
  return others;
}

void take(const FruitMatching& matching, Verdict verdict, std::vector<FruitVerdict>& verdicts) {
  for (const FruitPair& pair : matching.pairs) {
    FruitVerdict& v = verdicts[static_cast<std::size_t>(pair.estimate)];
    v = {verdict, static_cast<std::size_t>(pair.truth), pair.distance_m};
  }
}

/// Estimates not taken yet that are fruits which do not count.
void take_green(const std::vector<Vec3>& centres, const std::vector<FruitTruth>& truth,
                std::vector<FruitVerdict>& verdicts) {
  std::vector<Vec3> left;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (verdicts[i].verdict != Verdict::wrong) continue;
    left.push_back(centres[i]);
    index.push_back(i);
  }
  for (const FruitPair& pair : match_optimal(left, uncounted(truth)).pairs) {
    verdicts[index[static_cast<std::size_t>(pair.estimate)]].verdict = Verdict::green;
  }
}

}  // namespace

std::vector<FruitVerdict> fruit_verdicts(const std::vector<FruitEstimate>& fruits,
                                         const std::vector<FruitTruth>& truth) {
  std::vector<FruitVerdict> verdicts(fruits.size());
  if (truth.empty()) return verdicts;
  std::vector<Vec3> centres;
  for (const FruitEstimate& fruit : fruits) centres.push_back(fruit.centre);
  for (FruitVerdict& v : verdicts) v.verdict = Verdict::wrong;
  take(match_greedy(centres, truth), Verdict::near, verdicts);
  take(match_optimal(centres, truth), Verdict::found, verdicts);
  take_green(centres, truth, verdicts);
  return verdicts;
}

}  // namespace canopeer
