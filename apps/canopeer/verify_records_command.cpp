#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/best_known.h"
#include "canopeer/campaign/job_pool.h"
#include "canopeer/campaign/suite.h"
#include "canopeer/config/protocols.h"
#include "canopeer/record/yardstick_shares.h"
#include "commands.h"
#include "exit_status.h"
#include "records.h"
#include "shipped_data.h"
#include "stop_signal.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

/// A best result, and the run that must give it again.
struct Claim {
  fs::path record;
  std::string which;  ///< clairvoyant, best_found or best_auc
  BestResult result;
  CampaignPlan plan;
  fs::path out;
};

/// What came of it.
struct Verdict {
  bool good = false;
  std::string text;
};

std::string digits(double auc) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", auc);
  return text;
}

fs::path mission_of_record(const fs::path& file, const Yardstick& yardstick) {
  if (file.parent_path().parent_path().filename() == "suite") {
    const Suite suite = value_or_stop(load_suite(shipped_data() / "benchmark"), kBadInput);
    const SuiteWorld* const world = suite.find(yardstick.mission);
    if (world == nullptr) {
      stop_with(kBadInput, {file.string() + ": mission: there is no world '" + yardstick.mission +
                            "' in CanopeerBench"});
    }
    return world->mission;
  }
  return mission_file_of(yardstick.mission);
}

/// Every result once: the best found and the best AUC are often the same run.
std::vector<Claim> claims_of(const fs::path& file, const Yardstick& y, const fs::path& out) {
  std::vector<Claim> claims;
  std::set<std::string> seen;
  for (const auto& [which, result] :
       {std::pair{"clairvoyant", &y.clairvoyant}, std::pair{"best_found", &y.best_found},
        std::pair{"best_auc", &y.best_auc}}) {
    if (!*result) continue;
    const BestResult& best = **result;
    Claim claim{file, which, best, {}, out / (std::to_string(claims.size() + 1) + "_" + which)};
    claim.plan.missions = {mission_of_record(file, y)};
    claim.plan.runs = 1;
    claim.plan.first_seed = best.seed;
    if (y.protocol != kOwnProtocol) claim.plan.protocols = {y.protocol};
    Contestant contestant{best.planner, {}};
    if (!best.plan.empty()) {
      contestant.planner = "playback";
      claim.plan.settings.push_back("playback.plan=" +
                                    fs::absolute(file.parent_path() / best.plan).string());
    }
    constexpr std::string_view kTable = "compute_table=";
    for (const std::string& setting : best.settings) {
      if (setting.starts_with(kTable)) {
        contestant.table = setting.substr(kTable.size());
      } else {
        claim.plan.settings.push_back(setting);
      }
    }
    claim.plan.contestants = {contestant};
    std::string key = contestant.label() + " " + std::to_string(best.seed);
    for (const std::string& setting : claim.plan.settings) key += "\n" + setting;
    key += "\n" + digits(best.auc) + " " + std::to_string(best.detected);
    if (seen.insert(key).second) claims.push_back(std::move(claim));
  }
  return claims;
}

Verdict verdict_on(const Claim& claim, const std::atomic<bool>& stop) {
  std::string trouble;
  JobPoolOptions options;
  options.program = fs::read_symlink("/proc/self/exe");
  options.out = claim.out;
  const auto outcome = run_jobs(claim.plan, options, stop, [&](const CampaignProgress& p) {
    if (p.state == JobState::failed && p.changed != nullptr) trouble = p.message;
  });
  if (!outcome) return {false, outcome.error().message};
  const CampaignJob job = all_jobs(claim.plan).front();
  if (!is_done(claim.out, job)) return {false, trouble.empty() ? "interrupted" : trouble};
  const auto run = read_run_figures(claim.out, job, {});
  if (!run) return {false, run.error().message};
  const int detected = static_cast<int>(run->values[figure_index("detected")].value_or(-1.0));
  const double auc = run->values[figure_index("auc")].value_or(-1.0);
  const BestResult& said = claim.result;
  const std::string text = std::to_string(detected) + " found, AUC " + digits(auc);
  // Numbers in files have 17 digits, so equal results are equal to the last bit.
  if (detected == said.detected && auc == said.auc) return {true, text};
  return {false, text + "; the record says " + std::to_string(said.detected) + " found, AUC " +
                     digits(said.auc) + " by version " + said.version + ", this is " +
                     CANOPEER_VERSION};
}

struct Collection {
  std::vector<Claim> claims;
  int records = 0;
  int faults = 0;
};

/// PROTOCOL.json; plans lie beside.
bool is_record(const fs::path& file) {
  const std::string protocol = file.stem().string();
  return file.extension() == ".json" && (protocol == kOwnProtocol || find_protocol(protocol));
}

Collection collect(const fs::path& root, const fs::path& out) {
  Collection all;
  std::error_code code;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root, code)) {
    if (is_record(entry.path())) files.push_back(entry.path());
  }
  if (code) stop_with(kBadInput, {root.string() + ": " + code.message()});
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const Yardstick yardstick = value_or_stop(read_yardstick(file), kBadInput);
    ++all.records;
    for (const std::string& fault : contradictions(yardstick)) {
      std::fprintf(stderr, "canopeer: %s: %s\n", file.c_str(), fault.c_str());
      ++all.faults;
    }
    const fs::path its = out / fs::relative(file, root, code).replace_extension();
    for (Claim& claim : claims_of(file, yardstick, its)) all.claims.push_back(std::move(claim));
  }
  return all;
}

std::string line_on(const Claim& claim, const Verdict& verdict) {
  return claim.record.string() + ": " + claim.which + " by " + claim.result.planner + ", seed " +
         std::to_string(claim.result.seed) + ": " +
         (verdict.good ? "the same, " : "NOT the same: ") + verdict.text;
}

}  // namespace

/// Runs every best result again. Those made before, by the same command, are not made again.
void verify_records(const VerifyArguments& arguments) {
  const fs::path root = arguments.records.empty() ? records_folder() : fs::path(arguments.records);
  const bool keep = !arguments.out.empty();
  const fs::path out = keep
                           ? fs::path(arguments.out)
                           : fs::temp_directory_path() /
                                 ("canopeer-verify-" + std::to_string(static_cast<long>(getpid())));
  Collection all = collect(root, out);
  for (Claim& claim : all.claims) claim.plan.threads = 1;
  const std::atomic<bool>& stop = catch_stop_signals();
  std::atomic<std::size_t> next = 0;
  std::atomic<int> wrong = 0;
  std::mutex printing;
  const auto work = [&] {
    for (std::size_t i = next++; i < all.claims.size() && !stop; i = next++) {
      const Verdict verdict = verdict_on(all.claims[i], stop);
      wrong += verdict.good ? 0 : 1;
      const std::lock_guard lock(printing);
      std::printf("%s\n", line_on(all.claims[i], verdict).c_str());
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < std::max(1, arguments.jobs); ++i) workers.emplace_back(work);
  }
  std::error_code code;
  if (!keep) fs::remove_all(out, code);
  if (stop) throw Stop{kInterrupted};
  if (all.faults + wrong > 0) {
    stop_with(kFailed, {std::to_string(wrong) + " of " + std::to_string(all.claims.size()) +
                        " results are not given again, " + std::to_string(all.faults) +
                        " contradictions in " + std::to_string(all.records) + " records"});
  }
  std::printf("%d records, %zu results, all given again to the digit by version %s\n", all.records,
              all.claims.size(), CANOPEER_VERSION);
}

}  // namespace canopeer::app
