#include "canopeer/campaign/run_command.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

TEST(RunCommand, OnlyTheMissionsFolderMayDiffer) {
  const std::string command = "run\n/a/m.yaml\n--seed\n1\n---\nname: m\n";
  EXPECT_TRUE(same_command(command, command));
  EXPECT_TRUE(same_command(command, "run\n/somewhere/else/m.yaml\n--seed\n1\n---\nname: m\n"));
  EXPECT_TRUE(same_command(command, "run\nm.yaml\n--seed\n1\n---\nname: m\n"));
  EXPECT_FALSE(same_command(command, "run\n/a/n.yaml\n--seed\n1\n---\nname: m\n"));
  EXPECT_FALSE(same_command(command, "run\n/a/m.yaml\n--seed\n2\n---\nname: m\n"));
  EXPECT_FALSE(same_command(command, "run\n/a/m.yaml\n--seed\n1\n---\nname: k\n"));
  EXPECT_FALSE(same_command(command, ""));
  EXPECT_FALSE(same_command(command, "run"));
  EXPECT_FALSE(same_command(command, "run\n/a/m.yaml"));
}

TEST(RunCommand, DoesNotDependOnThreadsOrShard) {
  CampaignPlan plan;
  plan.missions = {"m.yaml"};
  plan.contestants = {{"vmp", ""}};
  const CampaignJob job = all_jobs(plan).front();
  const std::string command = command_text(plan, job);
  plan.threads = 8;
  plan.shards = 3;
  EXPECT_EQ(command_text(plan, job), command);
  plan.settings = {"graph.neighbors=4"};
  EXPECT_NE(command_text(plan, job), command);
}

}  // namespace
}  // namespace canopeer
