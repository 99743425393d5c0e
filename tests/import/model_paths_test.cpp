#include "canopeer/import/sdf/model_paths.h"

#include <gtest/gtest.h>

#include "world_files.h"

namespace canopeer {
namespace {

TEST(ModelPaths, FindsByScheme) {
  const test::WorldFiles files;
  const auto mesh = files.add("second/plant/meshes/a.dae", "x");
  const ModelPaths paths({files.path() / "first", files.path() / "second"});
  EXPECT_EQ(paths.find("model://plant/meshes/a.dae", "/"), mesh);
  EXPECT_EQ(paths.find("package://plant/meshes/a.dae", "/"), mesh);
  EXPECT_EQ(paths.find("meshes/a.dae", files.path() / "second/plant"), mesh);
  EXPECT_EQ(paths.find("../second/plant/meshes/a.dae", files.path() / "second"), mesh);
  EXPECT_EQ(paths.find(mesh.string(), "/nowhere"), mesh);
  EXPECT_EQ(paths.find("file://" + mesh.string(), "/nowhere"), mesh);
  EXPECT_FALSE(paths.find("model://plant/meshes/b.dae", "/").has_value());
  EXPECT_FALSE(paths.find("", files.path()).has_value());
}

TEST(ModelPaths, SaysWhereItLooked) {
  const ModelPaths paths({"/a", "/b"});
  EXPECT_EQ(paths.searched("model://plant", "/"), "searched: /a/plant, /b/plant");
  EXPECT_EQ(ModelPaths({}).searched("model://plant", "/"), "no --model-path was given");
}

}  // namespace
}  // namespace canopeer
