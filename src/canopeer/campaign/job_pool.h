#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/campaign/campaign_plan.h"

namespace canopeer {

enum class JobState { waiting, running, done, failed };

/// Where a campaign stands; given after every change.
struct CampaignProgress {
  int jobs = 0;
  int done = 0;
  int failed = 0;
  int running = 0;
  const CampaignJob* changed = nullptr;  ///< the run that has just ended
  JobState state = JobState::waiting;    ///< of it
  std::string message;                   ///< of a failed run: the last line it printed
};

/// Who makes a campaign's runs, and what of them is kept.
struct JobPoolOptions {
  std::filesystem::path program;  ///< canopeer
  std::filesystem::path out;      ///< the campaign's folder
  int processes = 1;              ///< at a time
  bool keep_maps = false;         ///< keep map.ot, map_roi.ot and pictures, tens of MB a run
};

/// Makes the runs as processes of this machine. A run is made in `DIR.RANDOM.part` and renamed
/// when it is whole; `DIR/command` holds the command that made it. Runs that are there are left
/// alone, so an interrupted campaign goes on where it was. A run that fails is reported, and the
/// others go on. What a failed run printed is kept in `DIR.log`.
///
/// Several processes, on one machine or on several that share the folder, may work on a campaign at
/// the same time: shards of it share nothing, and of two that make the same run the first to finish
/// counts.
///
/// When `stop` is set, the runs under way are ended and lost, and the call returns. Error: OUT
/// cannot be written, or holds runs made by other commands (another mission file, other settings).
[[nodiscard]] Expected<void> run_jobs(const CampaignPlan& plan, const JobPoolOptions& options,
                                      const std::atomic<bool>& stop,
                                      const std::function<void(const CampaignProgress&)>& report);

/// The run is there, whole.
[[nodiscard]] bool is_done(const std::filesystem::path& out, const CampaignJob& job);

}  // namespace canopeer
