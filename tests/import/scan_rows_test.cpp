#include "canopeer/import/scan_rows.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "canopeer/config/scan_rows_file.h"
#include "mesh_writers.h"
#include "world_files.h"

namespace canopeer {
namespace {

/// A scanned plant in millimetres beside the origin: a sheet of leaf, a red and a green fruit.
const Vec3 kRed(30, 0, 400);
const Vec3 kGreen(-40, 20, 600);
std::vector<test::Painted> scanned() {
  return {{"leaf", test::sheet(Vec3(-200, -150, 300), Vec3(200, 150, 300)), {60, 83, 22}, ""},
          {"stem", test::sheet(Vec3(-10, -10, 100), Vec3(10, 10, 100)), {101, 118, 40}, ""},
          {"red", test::ball(kRed, 35), {204, 41, 9}, ""},
          {"orange", test::ball(kGreen, 25), {227, 140, 23}, ""}};
}

ScanRowsOptions parse(const test::WorldFiles& files, const std::string& yaml) {
  auto options = parse_scan_rows(yaml, (files.path() / "rows.yaml").string());
  EXPECT_TRUE(options.has_value()) << options.error().message;
  return options.value_or(ScanRowsOptions{});
}

TEST(ScanRows, AColouredPlyStandsInRowsWithFruitsByColour) {
  const test::WorldFiles files;
  files.add("scan.ply", test::colored_ply(scanned()));
  const auto world = place_scans(parse(files,
                                       "scans:\n"
                                       "  - name: pepper\n"
                                       "    mesh: scan.ply\n"
                                       "    unit_m: 0.001\n"
                                       "    fruit_color: {hue_low_deg: -20, hue_high_deg: 40}\n"
                                       "    counted_color: {hue_low_deg: -20, hue_high_deg: 20}\n"
                                       "rows:\n"
                                       "  - {x_m: 0.75, y_from_m: -1, spacing_m: 0.5, count: 3, "
                                       "scans: pepper}\n"
                                       "plants:\n"
                                       "  - {scan: pepper, x_m: -0.75, y_m: 0, yaw_deg: 180}\n"));
  ASSERT_TRUE(world.has_value()) << world.error().message;
  ASSERT_EQ(world->scene.fruits.size(), 8U);
  EXPECT_EQ(world->scene.counted_fruits(), 4);
  // The foot, 100 mm up in the file, stands on the ground.
  for (int i = 0; i < 3; ++i) {
    const Vec3 expected = 1e-3 * (kRed - Vec3(0, 0, 100)) + Vec3(0.75, -1.0 + 0.5 * i, 0.0);
    const auto found =
        std::find_if(world->scene.fruits.begin(), world->scene.fruits.end(),
                     [&](const FruitTruth& f) { return (f.centre - expected).norm() < 1e-5; });
    ASSERT_NE(found, world->scene.fruits.end()) << i;
    EXPECT_TRUE(found->counted);
    EXPECT_EQ(found->model, "pepper_" + std::to_string(i + 1));
    EXPECT_NEAR(found->diameter_m, 0.07, 1e-3);
  }
  const Vec3 turned = Vec3(-0.03 - 0.75, 0, 0.3);
  EXPECT_TRUE(std::any_of(world->scene.fruits.begin(), world->scene.fruits.end(),
                          [&](const FruitTruth& f) { return (f.centre - turned).norm() < 1e-5; }));
}

TEST(ScanRows, FruitsMayComeAsASecondMesh) {
  const test::WorldFiles files;
  auto surfaces = scanned();
  files.add("fruits.ply", test::colored_ply({surfaces[2], surfaces[3]}));
  surfaces.resize(2);
  files.add("plant.ply", test::colored_ply(surfaces));
  const auto world =
      place_scans(parse(files,
                        "scans:\n  - {name: a, mesh: plant.ply, fruit_mesh: fruits.ply, unit_m: "
                        "0.001, origin: keep}\n"
                        "plants:\n  - {scan: a, x_m: 1, y_m: 2, z_m: 0.5}\nfloor: false\n"));
  ASSERT_TRUE(world.has_value()) << world.error().message;
  ASSERT_EQ(world->scene.fruits.size(), 2U);
  EXPECT_LT((world->scene.fruits[0].centre - Vec3(1.03, 2.0, 0.9)).norm(), 1e-5);
  EXPECT_EQ(world->scene.counted_fruits(), 2);
}

TEST(ScanRows, GltfAndPlyScansStandInARowInTurn) {
  const test::WorldFiles files;
  std::vector<test::Painted> metres = scanned();
  for (auto& s : metres) {
    for (auto& v : s.mesh.vertices) v *= 0.001F;
  }
  files.add("scan.bin", test::gltf_bin(metres));
  files.add("scan.gltf", test::gltf(metres, "scan.bin"));
  files.add("scan.ply", test::colored_ply(metres));
  const auto world = place_scans(
      parse(files,
            "scans:\n"
            "  - {name: a, mesh: scan.gltf, fruit_color: {hue_low_deg: -20, hue_high_deg: 40}}\n"
            "  - {name: b, mesh: scan.ply, fruit_color: {hue_low_deg: -20, hue_high_deg: 40}}\n"
            "rows:\n"
            "  - {x_m: 0, y_from_m: 0, spacing_m: 1, count: 4, scans: [a, b]}\n"));
  ASSERT_TRUE(world.has_value()) << world.error().message;
  ASSERT_EQ(world->scene.fruits.size(), 8U);
  for (int i = 0; i < 4; ++i) {
    const Vec3 expected = 1e-3 * (kRed - Vec3(0, 0, 100)) + Vec3(0, i, 0);
    const std::string model = (i % 2 == 0 ? "a_" : "b_") + std::to_string(i + 1);
    EXPECT_TRUE(std::any_of(world->scene.fruits.begin(), world->scene.fruits.end(),
                            [&](const FruitTruth& f) {
                              return (f.centre - expected).norm() < 1e-5 && f.model == model;
                            }))
        << i;
  }
}

TEST(ScanRows, YUpScansStandUp) {
  const test::WorldFiles files;
  test::Painted fruit = scanned()[2];
  for (auto& v : fruit.mesh.vertices) v = Eigen::Vector3f(v.x(), v.z(), -v.y());
  files.add("scan.ply", test::colored_ply({fruit}));
  const auto world = place_scans(
      parse(files,
            "scans:\n  - {name: a, mesh: scan.ply, fruit_color: {}, unit_m: 0.001, up_axis: y, "
            "origin: keep}\nplants:\n  - {scan: a, x_m: 0, y_m: 0}\n"));
  ASSERT_TRUE(world.has_value()) << world.error().message;
  ASSERT_EQ(world->scene.fruits.size(), 1U);
  EXPECT_LT((world->scene.fruits[0].centre - 1e-3 * kRed).norm(), 1e-5);
}

TEST(ScanRows, WhatIsWrongIsNamedWithItsLine) {
  const auto expect = [](const std::string& yaml, const std::vector<std::string>& words) {
    const auto options = parse_scan_rows(yaml, "rows.yaml");
    ASSERT_FALSE(options.has_value()) << yaml;
    for (const std::string& word : words) {
      EXPECT_NE(options.error().message.find(word), std::string::npos) << options.error().message;
    }
  };
  expect("scans: []\n", {"rows.yaml", "scans"});
  expect("scans:\n  - name: a\n    mesh: a.ply\nplants:\n  - {scan: a, x_m: 0, y_m: 0}\n",
         {"rows.yaml:3", "fruit_color"});
  expect("scans:\n  - {name: a, mesh: a.ply, fruit: x}\nplants:\n  - {scan: b, x_m: 0, y_m: 0}\n",
         {"rows.yaml:4", "'b'", "a"});
  expect(
      "scans:\n  - {name: a, mesh: a.ply, fruit: x}\nrows:\n  - {x_m: 0, y_from_m: 0, "
      "spacing: 1, count: 2, scans: a}\n",
      {"rows.yaml:4", "spacing", "spacing_m"});
  expect("scans:\n  - {name: a, mesh: a.ply, fruit: '('}\nplants:\n  - {scan: a, x_m: 0, y_m: 0}\n",
         {"rows.yaml:2", "regular expression"});
  const auto missing = place_scans(*parse_scan_rows(
      "scans:\n  - {name: a, mesh: no.ply, fruit: x}\nplants:\n  - {scan: a, x_m: 0, y_m: 0}\n",
      "rows.yaml"));
  ASSERT_FALSE(missing.has_value());
  EXPECT_NE(missing.error().message.find("scan 'a': no.ply"), std::string::npos);
}

TEST(ColorRange, HoldsAcrossRed) {
  const ColorRange red{-25, 30, 0.45, 0.2};
  EXPECT_TRUE(red.holds({204, 41, 9}));
  EXPECT_TRUE(red.holds({204, 9, 41}));      // hue 350°
  EXPECT_FALSE(red.holds({60, 83, 22}));     // green
  EXPECT_FALSE(red.holds({204, 180, 170}));  // pale
  EXPECT_FALSE(red.holds({30, 2, 2}));       // dark
  EXPECT_FALSE(red.holds({0, 0, 0}));
  const ColorRange blue{200, 260, 0.3, 0.1};
  EXPECT_TRUE(blue.holds({20, 40, 200}));
  EXPECT_FALSE(blue.holds({200, 40, 20}));
}

}  // namespace
}  // namespace canopeer
