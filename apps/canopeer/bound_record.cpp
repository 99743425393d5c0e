#include "bound_record.h"

#include <array>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/best_known.h"
#include "exit_status.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

std::array<std::optional<BestResult>*, 3> results_of(Yardstick& y) {
  return {&y.clairvoyant, &y.best_found, &y.best_auc};
}

std::set<std::string> plans_of(Yardstick& y) {
  std::set<std::string> plans;
  for (const auto* result : results_of(y)) {
    if (*result && !(*result)->plan.empty()) plans.insert((*result)->plan);
  }
  return plans;
}

/// tight10.json, clairvoyant_auc_1.json → tight10.auc_1.plan.json, or tight10.auc_1_b.plan.json
/// where that is taken.
std::string name_beside(const fs::path& record, const std::string& plan,
                        const std::set<std::string>& taken) {
  std::string what = fs::path(plan).stem().string();
  if (what.starts_with("clairvoyant_")) what.erase(0, std::string("clairvoyant_").size());
  const auto name = [&] { return record.stem().string() + "." + what + ".plan.json"; };
  while (taken.contains(name())) what += "_b";
  return name();
}

/// Plans of the record that it names no more.
void remove_others(const fs::path& record, const std::set<std::string>& named) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(record.parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    const bool plan = name.starts_with(record.stem().string() + ".") && name.ends_with("plan.json");
    if (plan && !named.contains(name)) fs::remove(entry.path(), ignored);
  }
}

}  // namespace

void expect_same_world(const fs::path& record, const Yardstick& found) {
  const std::optional<Yardstick> known = value_or_stop(known_yardstick(record), kBadInput);
  if (!known) return;
  const auto words = [](const Yardstick& y) {
    return y.mission + ", world " + y.world_hash + ", " + y.protocol;
  };
  // No hash: only runs of the benchmark suite were there so far.
  const bool same = known->mission == found.mission && known->protocol == found.protocol &&
                    (known->world_hash.empty() || known->world_hash == found.world_hash);
  if (same) return;
  stop_with(kBadInput, {record.string() + " is of another world (" + words(*known) +
                        "; this one: " + words(found) + "); remove it first"});
}

void keep_record(const fs::path& record, const fs::path& out, const Yardstick& found) {
  expect_same_world(record, found);
  std::optional<Yardstick> known = value_or_stop(known_yardstick(record), kBadInput);
  const std::set<std::string> there = known ? plans_of(*known) : std::set<std::string>();
  std::map<std::string, std::string> copied;  // from the folder's names to those beside the record
  Yardstick kept = found;
  for (auto* result : results_of(kept)) {
    if (!*result || (*result)->plan.empty()) continue;
    auto [at, fresh] = copied.try_emplace((*result)->plan);
    if (fresh) at->second = name_beside(record, (*result)->plan, there);
    (*result)->plan = at->second;
  }
  if (known) kept = with_better_of(kept, *known);
  if (const auto wrong = contradictions(kept); !wrong.empty()) {
    stop_with(kFailed, {record.string() + " is left as it is: " + wrong.front()});
  }
  std::error_code code;
  fs::create_directories(fs::absolute(record).parent_path(), code);
  for (const auto& [from, to] : copied) {
    const std::string plan = value_or_stop(read_file(out / from), kFailed);
    value_or_stop(write_file(fs::absolute(record).parent_path() / to, plan), kFailed);
  }
  value_or_stop(write_yardstick(record, kept), kFailed);
  remove_others(fs::absolute(record), plans_of(kept));
}

}  // namespace canopeer::app
