#include <gtest/gtest.h>

#include "canopeer/run/run.h"
#include "field_meshes.h"
#include "mesh_writers.h"

namespace canopeer {
namespace {

using test::Painted;

/// A plant whose colours are in TGA pictures only: three fruits, and leaves that alpha cuts out.
void add_plant(const test::WorldFiles& files) {
  std::vector<Painted> surfaces;
  for (const double z : {0.55, 0.75, 0.95}) {
    surfaces.push_back(
        {"fruit_skin", test::ball(Vec3(0.08, 0.3 * (z - 0.75), z), 0.04), {}, "fruit.tga"});
  }
  for (const double z : {0.45, 1.05}) {
    surfaces.push_back(
        {"leaf", test::sheet(Vec3(-0.15, -0.15, z), Vec3(0.15, 0.15, z)), {}, "leaf.tga"});
  }
  files.add("models/plant/materials/textures/fruit.tga", test::tga({205, 25, 15}));
  files.add("models/plant/materials/textures/leaf.tga", test::leaf_tga({50, 110, 30}));
  files.add("models/plant/meshes/plant.dae", test::dae(surfaces));
  files.add_model("plant", test::mesh_visual("model://plant/meshes/plant.dae"));
}

Expected<Summary> run(const test::WorldFiles& files, std::vector<std::string>* notices) {
  StageRequest request;
  request.mission = files.path() / "mission.yaml";
  request.table_dirs = {CANOPEER_SOURCE_DIR "/compute_tables"};
  request.callbacks.on_notice = [notices](const std::string& text) { notices->push_back(text); };
  const auto run = Run::compose(request, RunRegistries::built_in(), files.path() / "out");
  if (!run) return tl::unexpected(run.error());
  return (*run)->execute();
}

TEST(FieldWorlds, AMissionFindsFruitsWhoseTexturesAreTga) {
  const test::WorldFiles files;
  add_plant(files);
  files.add_world(
      "<include><uri>model://plant</uri><name>a</name><pose>-0.75 -1.3 0 0 0 0</pose></include>"
      "<include><uri>model://plant</uri><name>b</name><pose>-0.75 -0.8 0 0 0 0</pose></include>");
  files.add("mission.yaml", "name: tga\nrobot: " CANOPEER_SOURCE_DIR
                            "/robots/ur5e_trolley/robot.yaml\nplanner: vmp\ntime_per_segment_s: 6\n"
                            "stops_travel_m: [1]\nsides: [1]\nworld:\n  import: world.world\n"
                            "  model_path: models\n  fruit: fruit\n  leaf: leaf\n");
  std::vector<std::string> notices;
  const auto summary = run(files, &notices);
  ASSERT_TRUE(summary.has_value()) << summary.error().message;
  EXPECT_EQ(summary->fruits_total, 6);
  EXPECT_GE(summary->detected.value_or(0), 3);
  EXPECT_EQ(summary->false_positives, 0);
  EXPECT_TRUE(notices.empty()) << notices.front();

  std::filesystem::remove(files.models() / "plant/materials/textures/fruit.tga");
  const auto blind = run(files, &notices);
  ASSERT_TRUE(blind.has_value()) << blind.error().message;
  ASSERT_EQ(notices.size(), 2U);
  EXPECT_NE(notices[0].find("texture fruit.tga: not found"), std::string::npos);
  EXPECT_NE(notices[1].find("of 6 fruits that count, the detector 'colour' can see 0: 0.0 %"),
            std::string::npos);
}

}  // namespace
}  // namespace canopeer
