#include "canopeer/report/report.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include "canopeer/base/atomic_file.h"
#include "canopeer/report/run_files.h"
#include "synthetic_run.h"

namespace canopeer {
namespace {

using testing_support::SyntheticRunOptions;

/// The page of a synthetic run; the directory stays for a look at it.
std::string page_of(const std::string& name, const SyntheticRunOptions& options) {
  const auto dir = std::filesystem::path(testing::TempDir()) / ("canopeer_report_" + name);
  testing_support::write_synthetic_run(dir, options);
  const Expected<void> written = write_report(dir);
  EXPECT_TRUE(written.has_value()) << written.error().message;
  return *read_file(dir / "report.html");
}

bool has(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

void expect_sound(const std::string& page) {
  EXPECT_FALSE(has(page, "nan")) << page.substr(page.find("nan") - 80, 160);
  EXPECT_FALSE(has(page, "<script"));
  EXPECT_FALSE(has(page, "src=\"http"));
  EXPECT_FALSE(has(page, "href="));
  EXPECT_FALSE(has(page, "synthetic <row>")) << "names from files must be escaped";
}

TEST(Report, ShowsAWholeRunWithItsGroundTruth) {
  const std::string page = page_of("full", {});
  expect_sound(page);
  for (const char* part : {"<small>of 47</small>", "Fruits over time", "Fruit map",
                           "Time between two views", "Where the time goes", "stop 4, side 2",
                           "Row from above", "look_ahead_rad", "All figures"}) {
    EXPECT_TRUE(has(page, part)) << part;
  }
  EXPECT_FALSE(has(page, "interrupted"));
}

TEST(Report, ShowsFramesOnTheWay) {
  const std::string page = page_of("frames", {.segments = 3, .on_the_way = true});
  expect_sound(page);
  for (const char* part : {"frames taken in on the way", "<h2>Frames on the way</h2>", "to a view",
                           "home", "first known on the way", "T: where the mission",
                           "counted: 3 min 09 s", "frames on<br>the way", "on the way as specks",
                           "class=\"speck\"", "image motion during the exposure / px"}) {
    EXPECT_TRUE(has(page, part)) << part;
  }
  const std::string without = page_of("no_frames", {.segments = 3});
  for (const char* part : {"on the way", "counted:", "T: where"}) {
    EXPECT_FALSE(has(without, part)) << part;
  }
}

TEST(Report, CountsFruitsOfFramesOnTheWayInAKilledRun) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "canopeer_report_killed_frames";
  testing_support::write_synthetic_run(dir, {.segments = 1, .truth = false, .on_the_way = true});
  const std::string record = *read_file(dir / "record");
  const std::size_t last_frame = record.rfind("\n{\"frame\"");
  ASSERT_NE(last_frame, std::string::npos);
  std::filesystem::remove_all(dir);
  std::filesystem::create_directories(dir);
  ASSERT_TRUE(write_file(dir / "record", record.substr(0, record.find('\n', last_frame + 1) + 1)));
  const Expected<RunFiles> files = read_run_files(dir);
  ASSERT_TRUE(files.has_value()) << files.error().message;
  ASSERT_GT(files->record.frames.back().t_s, files->record.views.back().t_s);
  EXPECT_EQ(files->fruits.size(), files->record.frames.back().fruits.size());
  EXPECT_EQ(files->summary.fruits_reported, static_cast<int>(files->fruits.size()));
}

TEST(Report, SameDirectoryGivesTheSamePage) { EXPECT_EQ(page_of("same", {}), page_of("same", {})); }

TEST(Report, WorksForAnInterruptedRun) {
  const std::string page = page_of("interrupted", {.interrupted = true});
  expect_sound(page);
  EXPECT_TRUE(has(page, "This run was interrupted"));
  EXPECT_TRUE(has(page, "5 of 8 segments"));
}

TEST(Report, WorksWithoutFruitsAndWithoutGroundTruth) {
  for (const bool truth : {false, true}) {
    const std::string page = page_of("none", {.segments = 1, .truth = truth, .fruits = false});
    expect_sound(page);
    EXPECT_TRUE(has(page, "No fruit was reported"));
  }
  const std::string page = page_of("real", {.truth = false});
  expect_sound(page);
  EXPECT_TRUE(has(page, "fruits reported"));
  EXPECT_FALSE(has(page, "within 20 cm"));
}

TEST(Report, SaysWhatTheRunWasToldAndWhyItFailed) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "canopeer_report_told";
  testing_support::write_synthetic_run(dir, {.interrupted = true});
  const std::string lines =
      R"({"steering":{"t_s":12.5,"segment":0,"said":"wait_for_person","by":"trolley","why":"push <it>"}})"
      "\n"
      R"({"fault":{"t_s":300.0,"message":"camera: cable pulled"}})"
      "\n";
  ASSERT_TRUE(write_file(dir / "record", *read_file(dir / "record") + lines));
  ASSERT_TRUE(write_report(dir).has_value());
  const std::string page = *read_file(dir / "report.html");
  expect_sound(page);
  EXPECT_TRUE(has(page, "told to wait for person by \u201ctrolley\u201d: push &lt;it&gt;."));
  EXPECT_TRUE(has(page, "it failed: camera: cable pulled."));
}

/// As a killed run leaves it: the first part of its record and nothing else.
std::string page_of_killed_run(std::size_t record_bytes) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "canopeer_report_killed";
  testing_support::write_synthetic_run(dir, {});
  const std::string record = read_file(dir / "record")->substr(0, record_bytes);
  std::filesystem::remove_all(dir);
  std::filesystem::create_directories(dir);
  EXPECT_TRUE(write_file(dir / "record", record));
  const Expected<void> written = write_report(dir);
  EXPECT_TRUE(written.has_value()) << written.error().message;
  return *read_file(dir / "report.html");
}

TEST(Report, WorksFromTheRecordAloneWhenTheRunWasKilled) {
  const std::string early = page_of_killed_run(250);
  expect_sound(early);
  EXPECT_TRUE(has(early, "This run was interrupted"));
  const std::string late = page_of_killed_run(200'000);
  expect_sound(late);
  EXPECT_TRUE(has(late, "fruits reported"));
  EXPECT_TRUE(has(late, "Fruit map"));
}

TEST(Report, ErrorsNameTheFileAtFault) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "canopeer_report_errors";
  testing_support::write_synthetic_run(dir, {});
  ASSERT_TRUE(write_file(dir / "fruits.csv", "id,x_m\n0,abc\n"));
  EXPECT_TRUE(has(write_report(dir).error().message, "fruits.csv:2: 'abc' in column 'x_m'"));
  std::filesystem::remove(dir / "record");
  EXPECT_TRUE(has(write_report(dir).error().message, "record: cannot read"));
}

TEST(Report, DrawingsAreWellFormedXml) {
  const std::string page = page_of("xml", {});
  const auto dir = std::filesystem::path(testing::TempDir()) / "canopeer_report_xml";
  std::size_t drawings = 0;
  for (std::size_t at = page.find("<svg"); at != std::string::npos;
       at = page.find("<svg", at + 1)) {
    const std::size_t end = page.find("</svg>", at) + 6;
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.Parse(page.data() + at, end - at), tinyxml2::XML_SUCCESS)
        << document.ErrorStr();
    ++drawings;
  }
  EXPECT_EQ(drawings, 6U);
  tinyxml2::XMLDocument map;
  EXPECT_EQ(map.LoadFile((dir / "fruit_map.svg").c_str()), tinyxml2::XML_SUCCESS);
}

}  // namespace
}  // namespace canopeer
