#include "canopeer/config/world_section.h"

#include <gtest/gtest.h>

#include <set>

#include "canopeer/base/atomic_file.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

fs::path file_of_test(const std::string& text) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const fs::path path =
      fs::temp_directory_path() / (std::string("canopeer_world_") + test->name() + ".yaml");
  EXPECT_TRUE(write_file(path, text));
  return path;
}

Expected<SceneFile> scene_with(const std::string& text) {
  const fs::path path = file_of_test(text);
  auto scene = load_scene_file(path);
  fs::remove(path);
  return scene;
}

TEST(WorldSection, EveryNamedWorldCanBeChosen) {
  for (const std::string& name : world_names()) {
    const auto file = scene_with("preset: " + name + "\n");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->world.generated.plants.size(), named_world(name)->plants.size());
  }
}

TEST(WorldSection, RowsLevelsAndFurnitureComeFromTheFile) {
  const auto file = scene_with(
      "preset: empty\nseed: 4\nrows:\n  - {x_m: 0.8, count: 5, spacing_m: 0.4, preset: seedling, "
      "levels_m: [0, 1.1]}\n  - {x_m: -0.8, count: 3, kinds: [3, 8]}\nwalls: false\ngutters: true\n"
      "pipe_x_m: [0]\nalong_y_m: [-3, 5]\n");
  ASSERT_TRUE(file) << file.error().message;
  const WorldOptions& o = file->world.generated;
  EXPECT_EQ(file->seed, 4U);
  ASSERT_EQ(o.plants.size(), 13U);
  EXPECT_EQ(o.boards.size(), 1U);
  EXPECT_NEAR(o.boards[0].max().z(), 1.1, 1e-12);
  EXPECT_EQ(o.plants[5].position.z(), 1.1);
  EXPECT_EQ(o.plants[5].preset, PlantPreset::seedling);
  EXPECT_EQ(o.plants[11].kind, 8);
  EXPECT_FALSE(o.walls);
  EXPECT_TRUE(o.gutters);
  EXPECT_EQ(o.pipe_x_m, (std::vector<double>{0.0}));
  EXPECT_EQ(o.high_y_m, 5.0);
  const Scene scene = make_world(o, 4);
  EXPECT_EQ(scene.plant_count(), 13);
}

TEST(WorldSection, RefusesWhatCannotBe) {
  const auto complaint = [](const std::string& text) {
    const auto file = scene_with(text);
    return file ? "accepted" : file.error().message;
  };
  EXPECT_NE(complaint("preset: dense_3\n").find("dense_1"), std::string::npos);
  EXPECT_NE(complaint("rows: [{count: 3}]\n").find("x_m"), std::string::npos);
  EXPECT_NE(complaint("rows: [{x_m: 1, kinds: [2.5]}]\n").find("whole"), std::string::npos);
  EXPECT_NE(complaint("along_y_m: [2, 1]\n").find("low < high"), std::string::npos);
  EXPECT_NE(complaint("gutter: true\n").find("gutters"), std::string::npos);
  EXPECT_NE(complaint("rows: [{x_m: 1, count: 20000}, {x_m: 2}]\n").find("at most"),
            std::string::npos);
}

TEST(WorldSection, AMissionIsNoSceneFile) {
  EXPECT_FALSE(is_scene_file(CANOPEER_SOURCE_DIR "/missions/scenario_1.yaml"));
  const fs::path path = file_of_test("preset: dense_1\n");
  EXPECT_TRUE(is_scene_file(path));
  fs::remove(path);
}

}  // namespace
}  // namespace canopeer
