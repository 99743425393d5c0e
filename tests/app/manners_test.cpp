#include <gtest/gtest.h>

#include "canopeer/base/atomic_file.h"
#include "program.h"

// What a user expects of any program.

namespace canopeer {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Manners, ItSaysItsVersionAndItsExitStatus) {
  const auto version = test::canopeer({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(has(version.out, "canopeer ")) << version.out;
  EXPECT_TRUE(has(test::canopeer({"--help"}).out, "130 interrupted"));
}

TEST(Manners, ShippedMissionsGoByTheirNames) {
  const test::TemporaryDirectory directory;
  const std::string out = (directory / "out").string();
  const auto run =
      test::canopeer({"run", "smoke", "--time-per-segment", "2", "--quiet", "--out", out});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(read_file(directory / "out" / "summary.json").has_value());
  const auto unknown = test::canopeer({"run", "smokee"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(has(unknown.err, "smokee") && has(unknown.err, "scenario_1")) << unknown.err;
}

TEST(Manners, TheDoctorSaysWhatIsThereAndTriesIt) {
  const auto doctor = test::canopeer({"doctor"});
  EXPECT_EQ(doctor.status, 0) << doctor.err;
  for (const char* what :
       {"cores", "GB", "compute table", "vmp", "colour", "simulation", "scenario_1", "real time"}) {
    EXPECT_TRUE(has(doctor.out, what)) << what << " in\n" << doctor.out;
  }
  EXPECT_FALSE(has(test::canopeer({"doctor", "--quick"}).out, "self-test"));
}

TEST(Manners, AWrongSiteOrOutputFolderIsSaidAtOnce) {
  const auto site = test::canopeer({"run", "smoke", "--site", "mars"});
  EXPECT_EQ(site.status, 2);
  EXPECT_TRUE(has(site.err, "canopeer: unknown site 'mars'; there is: simulation")) << site.err;
  const auto out = test::canopeer({"run", "smoke", "--out", "/proc/nowhere"});
  EXPECT_EQ(out.status, 2);
  EXPECT_TRUE(has(out.err, "/proc/nowhere")) << out.err;
}

}  // namespace
}  // namespace canopeer
