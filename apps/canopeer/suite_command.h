#pragma once

#include "canopeer/campaign/campaign_plan.h"
#include "commands.h"

namespace canopeer::app {

/// The plan that `bench` makes of its arguments; ends the command when they are wrong.
[[nodiscard]] CampaignPlan bench_plan(const BenchArguments& arguments);

}  // namespace canopeer::app
