#include "canopeer/campaign/job_pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <system_error>
#include <thread>

#include "canopeer/base/atomic_file.h"
#include "canopeer/campaign/run_command.h"
#include "canopeer/campaign/run_folder.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

fs::path with_ending(fs::path path, const char* ending) { return path += ending; }

std::string last_line(const fs::path& log) {
  std::string text = read_file(log).value_or("");
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t end = text.rfind('\n');
  return end == std::string::npos ? text : text.substr(end + 1);
}

/// Starts the program with its output going to `log`; −1 with errno when it cannot.
pid_t start(const fs::path& program, const std::vector<std::string>& arguments,
            const fs::path& log) {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string log_name = log.string();
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child != 0) return child;
  // Only calls that are safe after a fork. When the campaign is killed its runs end too.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);  // a Ctrl-C is the campaign's to handle
  const int file = open(log_name.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  execv(argv[0], argv.data());
  _exit(127);
}

class JobPool {
 public:
  JobPool(const CampaignPlan& plan, const JobPoolOptions& options,
          const std::function<void(const CampaignProgress&)>& report)
      : plan_(plan), options_(options), report_(report), jobs_(shard_jobs(plan)) {
    progress_.jobs = static_cast<int>(jobs_.size());
  }

  Expected<void> find_done() {
    // Another shard's runs lie in the same folder, and must be of the same campaign.
    for (const auto& job : all_jobs(plan_)) {
      if (!is_done(options_.out, job)) continue;
      if (auto ok = made_by_this_command(job); !ok) return ok;
    }
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (is_done(options_.out, jobs_[i])) {
        ++progress_.done;
      } else {
        waiting_.push_back(i);
      }
    }
    std::reverse(waiting_.begin(), waiting_.end());  // taken from the back
    return {};
  }

  Expected<void> run(const std::atomic<bool>& stop) {
    report_(progress_);
    while ((!waiting_.empty() || !running_.empty()) && !stop) {
      while (!waiting_.empty() && static_cast<int>(running_.size()) < options_.processes) {
        if (auto ok = start_next(); !ok) {
          end_all();
          return ok;
        }
      }
      collect();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    end_all();
    return {};
  }

 private:
  struct Running {
    std::size_t number;  ///< of the job
    RunFolder folder;
  };

  [[nodiscard]] Expected<void> made_by_this_command(const CampaignJob& job) const {
    const fs::path file = options_.out / job.dir / "command";
    if (same_command(read_file(file).value_or(""), command_text(plan_, job))) return {};
    return fail(file.parent_path().string() +
                ": was made by another command or another mission file (see " + file.string() +
                "); choose another --out, or remove it");
  }

  Expected<void> start_next() {
    const std::size_t number = waiting_.back();
    waiting_.pop_back();
    const CampaignJob& job = jobs_[number];
    if (is_done(options_.out, job)) {  // by another process, meanwhile
      if (auto ok = made_by_this_command(job); !ok) return ok;
      tell(job, true);
      return {};
    }
    RunFolder folder(options_.out / job.dir);
    if (auto ok = folder.begin(); !ok) return ok;
    const pid_t child = start(options_.program, run_arguments(plan_, job, folder.part()),
                              with_ending(folder.dir(), ".log"));
    if (child < 0) return fail(fmt::format("no process can be started: {}", std::strerror(errno)));
    running_.emplace(child, Running{number, std::move(folder)});
    progress_.running = static_cast<int>(running_.size());
    return {};
  }

  void collect() {
    for (auto it = running_.begin(); it != running_.end();) {
      int status = 0;
      if (waitpid(it->first, &status, WNOHANG) == 0) {
        ++it;
        continue;
      }
      const Running ended = std::move(it->second);
      it = running_.erase(it);
      progress_.running = static_cast<int>(running_.size());
      const CampaignJob& job = jobs_[ended.number];
      bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0 && keep(job, ended.folder);
      if (!good && is_done(options_.out, job)) {  // another process was first
        ended.folder.drop();
        good = made_by_this_command(job).has_value();
      }
      if (!good) ended.folder.leave();
      tell(job, good);
    }
  }

  void tell(const CampaignJob& job, bool good) {
    const fs::path log = with_ending(options_.out / job.dir, ".log");
    std::error_code code;
    progress_.changed = &job;
    progress_.state = good ? JobState::done : JobState::failed;
    progress_.message = good ? "" : last_line(log);
    ++(good ? progress_.done : progress_.failed);
    if (good) fs::remove(log, code);
    report_(progress_);
    progress_.changed = nullptr;
  }

  [[nodiscard]] bool keep(const CampaignJob& job, const RunFolder& folder) const {
    std::error_code code;
    if (!options_.keep_maps) {
      for (const char* name : {"map.ot", "map_roi.ot", "pictures"})
        fs::remove_all(folder.part() / name, code);
    }
    return write_file(folder.part() / "command", command_text(plan_, job)).has_value() &&
           folder.finish().has_value();
  }

  void end_all() {
    for (const auto& [child, run] : running_) kill(child, SIGKILL);
    for (const auto& [child, run] : running_) {
      waitpid(child, nullptr, 0);
      run.folder.drop();
    }
    running_.clear();
  }

  const CampaignPlan& plan_;
  const JobPoolOptions& options_;
  const std::function<void(const CampaignProgress&)>& report_;
  std::vector<CampaignJob> jobs_;
  std::vector<std::size_t> waiting_;
  std::map<pid_t, Running> running_;
  CampaignProgress progress_;
};

}  // namespace

bool is_done(const fs::path& out, const CampaignJob& job) {
  std::error_code code;
  return fs::exists(out / job.dir / "command", code);
}

Expected<void> run_jobs(const CampaignPlan& plan, const JobPoolOptions& options,
                        const std::atomic<bool>& stop,
                        const std::function<void(const CampaignProgress&)>& report) {
  JobPool pool(plan, options, report);
  if (auto ok = pool.find_done(); !ok) return ok;
  return pool.run(stop);
}

}  // namespace canopeer
