#include "canopeer/campaign/campaign_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <system_error>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/job_pool.h"
#include "canopeer/campaign/run_command.h"
#include "canopeer/campaign/run_folder.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNamedAtMost = 10;

/// A run to take, or one that is there already.
struct FoundRun {
  const CampaignJob* job = nullptr;
  fs::path folder;  ///< the campaign it is in
};

/// Runs depend on nothing but their command, so two of them differ only where the programs did.
bool same_record(const fs::path& one, const fs::path& other) {
  const auto of_one = read_file(one / "record");
  const auto of_other = read_file(other / "record");
  return of_one && of_other && *of_one == *of_other;
}

/// Looks through all folders, `out` first: which runs to take from where, and what speaks against
/// it.
class Survey {
 public:
  Survey(const CampaignPlan& plan, const std::vector<CampaignJob>& jobs) : plan_(plan) {
    for (const auto& job : jobs) wanted_.push_back({&job, {}});
  }

  void look_at(const fs::path& folder) {
    for (auto& run : wanted_) {
      if (!is_done(folder, *run.job)) continue;
      const std::string command = read_file(folder / run.job->dir / "command").value_or("");
      if (!same_command(command, command_text(plan_, *run.job))) {
        wrong_.push_back((folder / run.job->dir).string() +
                         ": was made by another command or another mission file");
      } else if (run.folder.empty()) {
        run.folder = folder;
      } else if (!same_record(run.folder / run.job->dir, folder / run.job->dir)) {
        wrong_.push_back((folder / run.job->dir).string() + ": is another run than " +
                         (run.folder / run.job->dir).string() +
                         " (another version of the program?)");
      } else {
        ++twice_;
      }
    }
  }

  [[nodiscard]] Expected<void> verdict() const {
    if (wrong_.empty()) return {};
    std::string text = wrong_.size() == 1 ? "" : fmt::format("{} runs clash: ", wrong_.size());
    for (std::size_t i = 0; i < std::min(wrong_.size(), kNamedAtMost); ++i) {
      text += (i == 0 ? "" : "; ") + wrong_[i];
    }
    if (wrong_.size() > kNamedAtMost) text += "; …";
    return fail(text +
                ". Nothing was joined: leave these out, or merge with the command that made "
                "them");
  }

  [[nodiscard]] const std::vector<FoundRun>& runs() const { return wanted_; }
  [[nodiscard]] int twice() const { return twice_; }

 private:
  const CampaignPlan& plan_;
  std::vector<FoundRun> wanted_;
  std::vector<std::string> wrong_;
  int twice_ = 0;
};

std::error_code link_or_copy_file(const fs::path& from, const fs::path& to) {
  std::error_code code;
  fs::create_hard_link(from, to, code);
  if (code) fs::copy_file(from, to, code);  // another disk, or one that knows no links
  return code;
}

/// All files of a folder into another one, which is there and empty.
Expected<void> link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code code;
  fs::recursive_directory_iterator it(from, code);
  while (!code && it != fs::recursive_directory_iterator()) {
    const fs::path target = to / it->path().lexically_relative(from);
    if (it->is_directory(code)) {
      fs::create_directory(target, code);
    } else if (!code) {
      code = link_or_copy_file(it->path(), target);
    }
    if (!code) it.increment(code);
  }
  if (!code) return {};
  return fail(
      fmt::format("{}: cannot be copied to {}: {}", from.string(), to.string(), code.message()));
}

Expected<void> take(const FoundRun& run, const fs::path& out) {
  const RunFolder folder(out / run.job->dir);
  if (auto ok = folder.begin(); !ok) return ok;
  if (auto ok = link_or_copy(run.folder / run.job->dir, folder.part()); !ok) {
    folder.drop();
    return ok;
  }
  return folder.finish();
}

/// Runs below `part` that are whole, and of none of the jobs.
Expected<int> strangers_in(const fs::path& part, const std::set<fs::path>& known) {
  std::error_code code;
  int count = 0;
  bool any = false;
  for (fs::recursive_directory_iterator it(part / "runs", code), end; !code && it != end;
       it.increment(code)) {
    if (it->path().filename() != "command" || it->is_directory()) continue;
    const fs::path dir = it->path().parent_path();
    if (dir.extension() == ".part") continue;
    any = true;
    count += static_cast<int>(known.count(dir.lexically_relative(part)) == 0);
  }
  // A shard may have had nothing to do.
  if (!any && !fs::exists(part / "comparison.csv", code)) {
    return fail(part.string() + ": holds no runs; expected the --out folder of a campaign");
  }
  return count;
}

}  // namespace

Expected<MergeOutcome> merge_campaigns(const CampaignPlan& plan, const std::vector<fs::path>& parts,
                                       const fs::path& out) {
  const std::vector<CampaignJob> jobs = all_jobs(plan);
  std::set<fs::path> known;
  for (const auto& job : jobs) known.insert(job.dir);
  MergeOutcome outcome;
  Survey survey(plan, jobs);
  survey.look_at(out);
  for (const auto& part : parts) {
    std::error_code code;
    if (fs::equivalent(part, out, code)) {
      return fail(part.string() + ": is the folder to merge into; name the others only");
    }
    const auto strangers = strangers_in(part, known);
    if (!strangers) return fail(strangers.error().message);
    outcome.strangers += *strangers;
    survey.look_at(part);
  }
  if (auto ok = survey.verdict(); !ok) return fail(ok.error().message);
  outcome.twice = survey.twice();
  for (const auto& run : survey.runs()) {
    if (run.folder.empty() || run.folder == out) continue;
    if (auto ok = take(run, out); !ok) return fail(ok.error().message);
    ++outcome.taken;
  }
  return outcome;
}

}  // namespace canopeer
