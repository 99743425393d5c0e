#include "canopeer/campaign/run_command.h"

#include <filesystem>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

/// The command with the mission file's name in place of its path: the second line.
std::string without_folder(std::string_view command) {
  const std::size_t begin = command.find('\n');
  if (begin == std::string_view::npos) return std::string(command);
  const std::size_t end = command.find('\n', begin + 1);
  if (end == std::string_view::npos) return std::string(command);
  const std::filesystem::path mission(command.substr(begin + 1, end - begin - 1));
  return std::string(command.substr(0, begin + 1)) + mission.filename().string() +
         std::string(command.substr(end));
}

}  // namespace

std::string command_text(const CampaignPlan& plan, const CampaignJob& job) {
  std::string text;
  CampaignPlan same = plan;
  same.threads = 1;
  for (const auto& word : run_arguments(same, job, "OUT")) text += word + "\n";
  return text + "---\n" + read_file(job.mission).value_or("");
}

bool same_command(std::string_view one, std::string_view other) {
  return without_folder(one) == without_folder(other);
}

}  // namespace canopeer
