#pragma once

#include <filesystem>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/campaign/campaign_plan.h"

namespace canopeer {

/// What came of joining campaigns.
struct MergeOutcome {
  int taken = 0;      ///< runs that are new in the joint folder
  int twice = 0;      ///< runs that were there already, or in two of the parts: the same ones
  int strangers = 0;  ///< runs of the parts that the plan does not name; left where they are
};

/// Joins the plan's runs that were made in the folders `parts` (on other machines, say) into the
/// campaign's folder `out`. A run is taken whole, as hard links where the file system can, else as
/// copies; the parts are left as they are.
///
/// Everything is looked at before anything is taken. Error: a part that is no campaign's folder, or
/// is `out`; a run made by another command or mission file; two runs of the same name whose records
/// differ. It names each such run (ten at most). Or a file that cannot be read or written: what was
/// taken by then is whole, and the same call goes on from there.
[[nodiscard]] Expected<MergeOutcome> merge_campaigns(
    const CampaignPlan& plan, const std::vector<std::filesystem::path>& parts,
    const std::filesystem::path& out);

}  // namespace canopeer
