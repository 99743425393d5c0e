#include <gtest/gtest.h>

#include "canopeer/import/meshes/guarded_call.h"
#include "canopeer/import/scene_glb.h"
#include "canopeer/render/overview.h"
#include "field_meshes.h"

namespace canopeer {
namespace {

/// What `scene import` does, with half a gigabyte: fruits, or what went wrong.
std::string import_in_half_a_gigabyte(const test::WorldFiles& files,
                                      const std::filesystem::path& world) {
  const auto fruits = guarded_call(
      [&] {
        const auto read = test::import_all_as_fruit(world);
        if (!read.error.empty()) return read.error;
        if (render_overview(read.world.scene, 640, 360).empty()) return std::string("no picture");
        if (auto ok = write_scene_glb(files.path() / "scene.glb", read.world.scene); !ok) {
          return ok.error().message;
        }
        return std::to_string(read.world.scene.fruits.size());
      },
      {60.0, 512UL << 20U});
  return fruits ? *fruits : fruits.error().message;
}

TEST(FieldWorlds, TwoThousandBoxesTakeLessThanHalfAGigabyte) {
  const test::WorldFiles files;
  std::string models;
  for (int i = 0; i < 2000; ++i) {
    models += "<model name=\"p" + std::to_string(i) + "\"><static>1</static><pose>" +
              std::to_string(i % 20) + " " + std::to_string(i / 20) +
              " 0 0 0 0</pose><link name=\"l\">" + test::box_visual("0.08 0.08 0.08") +
              "</link></model>";
  }
  EXPECT_EQ(import_in_half_a_gigabyte(files, files.add_world(models)), "2000");
}

}  // namespace
}  // namespace canopeer
