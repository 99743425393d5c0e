#pragma once

#include <string>
#include <string_view>

#include "canopeer/campaign/campaign_plan.h"

namespace canopeer {

/// What a run depends on, as it lies beside it in the file `command`: its arguments, one a line,
/// `---`, the mission file's content. Not the number of threads, on which no result depends.
[[nodiscard]] std::string command_text(const CampaignPlan& plan, const CampaignJob& job);

/// Both make the same run: they are equal but for the folder in which the mission file lies, which
/// differs between machines.
[[nodiscard]] bool same_command(std::string_view one, std::string_view other);

}  // namespace canopeer
