#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/bounds/view_pool_file.h"
#include "canopeer/record/summary.h"
#include "canopeer/record/yardstick.h"
#include "program.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// The smoke mission with few views.
std::vector<std::string> bound(const fs::path& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"bound",
                                    "missions/smoke.yaml",
                                    "--views-per-fruit",
                                    "2",
                                    "--views-per-segment",
                                    "400",
                                    "--set",
                                    "time_per_segment_s=6",
                                    "--threads",
                                    "1",
                                    "--out",
                                    out.string()};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(BoundCommand, LeavesAYardstickThatPlansDoNotSurpass) {
  const test::TemporaryDirectory directory;
  const fs::path out = directory / "bound";
  const auto first = test::canopeer(bound(out));
  ASSERT_EQ(first.status, 0) << first.out << first.err;
  for (const char* text : {"visibility ceiling", "ceiling through the pipeline", "sampled bound",
                           "certified bound", "best plan for fruits"}) {
    EXPECT_NE(first.out.find(text), std::string::npos) << text << "\n" << first.out;
  }
  EXPECT_EQ(first.err.find("is below"), std::string::npos) << first.err;
  const auto yardstick = read_yardstick(out / "yardstick.json");
  ASSERT_TRUE(yardstick) << yardstick.error().message;
  EXPECT_EQ(yardstick->mission, "smoke");
  EXPECT_EQ(yardstick->world_hash.size(), 16U);
  EXPECT_GT(yardstick->ceiling_fruits.value_or(0), 0);
  ASSERT_TRUE(yardstick->best_found && yardstick->clairvoyant && yardstick->sampled);
  EXPECT_LE(yardstick->best_found->detected, *yardstick->ceiling_fruits);
  const auto run = read_summary(out / "clairvoyant_found_1" / "summary.json");
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->planner, "playback");
  EXPECT_GE(yardstick->best_found->detected, run->detected.value_or(0));
  EXPECT_FALSE(fs::exists(out / "views.part"));

  // Again: nothing is sampled or run anew, and the same comes out.
  const auto pool_time = fs::last_write_time(out / "views.pool");
  const auto run_time = fs::last_write_time(out / "clairvoyant_auc_1" / "summary.json");
  const auto before = read_file(out / "yardstick.json");
  const auto second = test::canopeer(bound(out));
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(fs::last_write_time(out / "views.pool"), pool_time);
  EXPECT_EQ(fs::last_write_time(out / "clairvoyant_auc_1" / "summary.json"), run_time);
  EXPECT_EQ(read_file(out / "yardstick.json").value(), before.value());

  // Into a record, with the plans; a better result that is there stays.
  const fs::path record = directory / "records" / "tight.json";
  const auto third = test::canopeer(bound(out, {"--record", record.string()}));
  ASSERT_EQ(third.status, 0) << third.err;
  auto kept = read_yardstick(record);
  ASSERT_TRUE(kept) << kept.error().message;
  ASSERT_TRUE(kept->best_auc);
  EXPECT_TRUE(fs::exists(record.parent_path() / kept->best_auc->plan));
  kept->best_auc->auc += 0.001;
  kept->best_auc->plan = "tight.mine.plan.json";
  ASSERT_TRUE(write_yardstick(record, *kept));
  ASSERT_TRUE(write_file(record.parent_path() / "tight.mine.plan.json", "a plan"));
  ASSERT_TRUE(write_file(record.parent_path() / "tight.old.plan.json", "named by none"));
  ASSERT_EQ(test::canopeer(bound(out, {"--record", record.string()})).status, 0);
  EXPECT_EQ(read_yardstick(record)->best_auc->plan, "tight.mine.plan.json");
  EXPECT_EQ(read_file(record.parent_path() / "tight.mine.plan.json").value(), "a plan");
  EXPECT_FALSE(fs::exists(record.parent_path() / "tight.old.plan.json"));
  kept->world_hash = "0000000000000000";
  ASSERT_TRUE(write_yardstick(record, *kept));
  const auto other = test::canopeer(bound(out, {"--record", record.string()}));
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("is of another world"), std::string::npos) << other.err;

  // Plans whose runs came to no end do not count, and are not made again.
  for (const auto& entry : fs::directory_iterator(out)) {
    const fs::path made = entry.path() / "made_of.txt";
    if (fs::exists(made)) fs::rename(made, entry.path() / "came_to_no_end.txt");
  }
  const auto without = test::canopeer(bound(out));
  EXPECT_EQ(without.status, 0) << without.err;
  EXPECT_NE(without.err.find("does not count"), std::string::npos) << without.err;
  EXPECT_FALSE(read_yardstick(out / "yardstick.json")->clairvoyant.has_value());
}

TEST(BoundCommand, UsesThePoolOfAnotherProtocolAndGoesOnAfterAStop) {
  const test::TemporaryDirectory directory;
  const fs::path pool = directory / "views.pool";
  const std::vector<std::string> few = {"--no-pipeline", "--no-plans", "--pool", pool.string()};
  const auto stopped = test::canopeer_interrupted(bound(directory / "one", few), directory / "one");
  EXPECT_TRUE(stopped.status == 130 || stopped.status == 0) << stopped.err;
  const auto whole = test::canopeer(bound(directory / "one", few));
  ASSERT_EQ(whole.status, 0) << whole.err;
  const auto made = fs::last_write_time(pool);
  std::vector<std::string> other = few;
  other.insert(other.end(), {"--protocol", "tight10"});
  std::vector<std::string> words = bound(directory / "two", other);
  words.erase(words.begin() + 6, words.begin() + 8);  // the protocol has its own time
  const auto tight = test::canopeer(words);
  ASSERT_EQ(tight.status, 0) << tight.err;
  EXPECT_EQ(fs::last_write_time(pool), made);
  EXPECT_TRUE(read_view_pool(pool));
  // Another seed is another world.
  words.insert(words.end(), {"--seed", "2", "--quiet"});
  const auto seed = test::canopeer(words);
  ASSERT_EQ(seed.status, 0) << seed.err;
  EXPECT_NE(seed.err.find("sampled anew"), std::string::npos) << seed.err;
}

TEST(BoundCommand, RefusesWhatItCannotDo) {
  const test::TemporaryDirectory directory;
  const auto none =
      test::canopeer({"bound", "missions/none.yaml", "--out", (directory / "x").string()});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("none.yaml"), std::string::npos) << none.err;
  const auto rules = test::canopeer(bound(directory / "x", {"--protocol", "nothing"}));
  EXPECT_EQ(rules.status, 2);
  EXPECT_NE(rules.err.find("nothing"), std::string::npos) << rules.err;
  EXPECT_EQ(test::canopeer({"bound", "missions/smoke.yaml"}).status, 2);
}

}  // namespace
}  // namespace canopeer
