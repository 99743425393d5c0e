// Readers of map files meet damaged files: they answer with an error or a map, and never crash. A
// deterministic, small relative of the fuzz targets.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "ball_scene.h"
#include "canopeer/base/atomic_file.h"
#include "canopeer/map/cmap_file.h"
#include "canopeer/map/octomap_file.h"

namespace canopeer {
namespace {

using Parse = std::function<bool(std::string_view)>;  ///< true: it was a map

VoxelMap small_map() { return BallScene::map(7, 1, 0.08); }

std::string octomap_bytes(Expected<void> (*write)(const VoxelMap&, const std::filesystem::path&)) {
  // Tests run side by side: each has files of its own.
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto path = std::filesystem::path(testing::TempDir()) / ("canopeer_damaged_" + test);
  EXPECT_TRUE(write(small_map(), path).has_value());
  return *read_file(path);
}

bool parses_octomap(std::string_view bytes) { return parse_octomap(bytes).has_value(); }
bool parses_cmap(std::string_view bytes) { return parse_cmap(bytes).has_value(); }

void expect_every_truncation_refused(const std::string& bytes, const Parse& parse) {
  ASSERT_TRUE(parse(bytes));
  const std::size_t step = bytes.size() / 400 + 1;
  for (std::size_t size = 0; size < bytes.size(); size += step) {
    EXPECT_FALSE(parse(std::string_view(bytes).substr(0, size))) << size << " of " << bytes.size();
  }
  EXPECT_FALSE(parse(std::string_view(bytes).substr(0, bytes.size() - 1)));
  EXPECT_FALSE(parse(bytes + '\0'));
}

// Returns how many of `tries` damaged files were still taken for maps.
int survive_mutations(const std::string& bytes, const Parse& parse, int tries) {
  Rng rng(1, "mutations");
  int taken = 0;
  for (int i = 0; i < tries; ++i) {
    std::string damaged = bytes;
    const int changes = 1 + static_cast<int>(rng.uniform(0.0, 4.0));
    for (int c = 0; c < changes; ++c) {
      const auto at =
          static_cast<std::size_t>(rng.uniform(0.0, 1.0) * static_cast<double>(damaged.size() - 1));
      switch (static_cast<int>(rng.uniform(0.0, 4.0))) {
        case 0:
          damaged[at] = static_cast<char>(damaged[at] ^ 1 << static_cast<int>(rng.uniform(0, 8)));
          break;
        case 1:
          damaged[at] = static_cast<char>(rng.uniform(0.0, 256.0));
          break;
        case 2:
          damaged.erase(at, 1 + static_cast<std::size_t>(rng.uniform(0.0, 8.0)));
          break;
        default:
          damaged.insert(at, 3, damaged[at]);
      }
    }
    if (damaged != bytes && parse(damaged)) ++taken;
  }
  return taken;
}

TEST(DamagedMapFiles, CutAnywhereAreRefused) {
  expect_every_truncation_refused(octomap_bytes(&write_ot), parses_octomap);
  expect_every_truncation_refused(octomap_bytes(&write_bt), parses_octomap);
  expect_every_truncation_refused(cmap_bytes(small_map()), parses_cmap);
}

TEST(DamagedMapFiles, NeverCrashTheReaders) {
  // OctoMap's formats have no checksum: a changed value is still a map.
  survive_mutations(octomap_bytes(&write_ot), parses_octomap, 300);
  survive_mutations(octomap_bytes(&write_bt), parses_octomap, 300);
}

TEST(DamagedMapFiles, AreAlwaysNoticedInOurOwnFormat) {
  EXPECT_EQ(survive_mutations(cmap_bytes(small_map()), parses_cmap, 3000), 0);
}

}  // namespace
}  // namespace canopeer
