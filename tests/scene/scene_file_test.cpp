#include "canopeer/scene/scene_file.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include "canopeer/base/byte_order.h"
#include "canopeer/base/rng.h"
#include "canopeer/scene/files/byte_streams.h"
#include "canopeer/scene/files/mesh_code.h"
#include "canopeer/scene/files/scene_format.h"
#include "canopeer/scene/scene_hash.h"
#include "canopeer/scene/worlds.h"

namespace canopeer {
namespace {

/// A small row of copies, so that models and instances are there too.
WorldOptions copied_row() {
  WorldOptions options;
  options.name = "copies";
  add_row({0.75, 0.0, 0.5, 3, 0.0, PlantPreset::numbered, {3}}, &options);
  options.copies = 2;
  return options;
}

WorldOptions small_row() {
  WorldOptions options;
  options.name = "small";
  add_row({0.75, 0.0, 0.5, 2, 0.0, PlantPreset::numbered, {5, 7}}, &options);
  return options;
}

/// A picture, colours of its own, normals that are not the surface's.
ScenePart painted_part() {
  ScenePart part;
  part.mesh = make_box(Box(Vec3(0, 0, 0), Vec3(0.1, 0.2, 0.3)));
  for (const auto& v : part.mesh.vertices) {
    part.mesh.normals.push_back((v - Eigen::Vector3f(0.01F, 0.2F, 0.4F)).normalized());
    part.uv.emplace_back(v.x(), v.y());
  }
  Texture texture;
  texture.name = "leaf.png";
  texture.color = ColorImage(3, 2, Rgb{1, 2, 3});
  texture.opacity = Image<std::uint8_t>(2, 2, 7);
  texture.cut_below = 99;
  part.texture = std::make_shared<Texture>(texture);
  part.see_through = true;
  return part;
}

void expect_same(const ScenePart& a, const ScenePart& b, double grid_m) {
  ASSERT_EQ(a.mesh.vertices.size(), b.mesh.vertices.size());
  ASSERT_EQ(a.mesh.normals.size(), b.mesh.normals.size());
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.plant, b.plant);
  EXPECT_EQ(a.fruit, b.fruit);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.vertex_colors, b.vertex_colors);
  EXPECT_EQ(a.see_through, b.see_through);
  EXPECT_EQ(a.uv, b.uv);
  for (std::size_t i = 0; i < a.mesh.vertices.size(); ++i) {
    // Half a step, and what a float leaves of it.
    EXPECT_LE((a.mesh.vertices[i] - b.mesh.vertices[i]).lpNorm<Eigen::Infinity>(),
              0.51 * grid_m + 1e-6);
  }
}

TEST(SceneFile, GivesBackTheSceneToTheGridAndTheTruthToTheBit) {
  for (const WorldOptions& options : {small_row(), copied_row()}) {
    Scene scene = make_world(options, 7);
    scene.parts.push_back(painted_part());
    const auto bytes = scene_bytes(scene);
    ASSERT_TRUE(bytes.has_value());
    const auto again = parse_scene(*bytes);
    ASSERT_TRUE(again.has_value()) << again.error().message;
    EXPECT_EQ(again->name, scene.name);
    EXPECT_EQ(again->seed, scene.seed);
    EXPECT_EQ(again->ground_m2, scene.ground_m2);
    ASSERT_EQ(again->parts.size(), scene.parts.size());
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
      expect_same(again->parts[i], scene.parts[i], 1e-4);
    }
    ASSERT_EQ(again->models.size(), scene.models.size());
    ASSERT_EQ(again->instances.size(), scene.instances.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      EXPECT_TRUE(again->instances[i].T_world_model.isApprox(scene.instances[i].T_world_model, 0));
      EXPECT_EQ(again->instances[i].brightness, scene.instances[i].brightness);
      EXPECT_EQ(again->instances[i].first_fruit, scene.instances[i].first_fruit);
    }
    ASSERT_EQ(again->fruits.size(), scene.fruits.size());
    for (std::size_t i = 0; i < scene.fruits.size(); ++i) {
      EXPECT_EQ(again->fruits[i].centre, scene.fruits[i].centre);
      EXPECT_EQ(again->fruits[i].volume_cm3, scene.fruits[i].volume_cm3);
      EXPECT_EQ(again->fruits[i].counted, scene.fruits[i].counted);
    }
    const Texture& texture = *again->parts.back().texture;
    EXPECT_EQ(texture.color.pixels(), scene.parts.back().texture->color.pixels());
    EXPECT_EQ(texture.opacity.pixels(), scene.parts.back().texture->opacity.pixels());
    EXPECT_EQ(texture.cut_below, 99);
    for (std::size_t i = 0; i < again->parts.back().mesh.normals.size(); ++i) {
      EXPECT_GT(again->parts.back().mesh.normals[i].dot(scene.parts.back().mesh.normals[i]), 0.999);
    }
    // What is read is written the same: nothing moves a second time.
    Scene plain = *again;
    plain.parts.pop_back();
    const auto once = scene_bytes(plain);
    ASSERT_TRUE(once.has_value());
    const auto twice = parse_scene(*once);
    ASSERT_TRUE(twice.has_value());
    EXPECT_EQ(scene_hash(*twice), scene_hash(plain));
    EXPECT_EQ(scene_bytes(*twice).value(), *once);
  }
}

TEST(SceneFile, IsAFewBytesAVertex) {
  const Scene scene = make_world(small_row(), 7);
  std::size_t vertices = 0;
  for (const ScenePart& part : scene.parts) vertices += part.mesh.vertices.size();
  EXPECT_LT(scene_bytes(scene)->size(), 4 * vertices);
}

TEST(SceneFile, RefusesWhatItCannotHold) {
  Scene far;
  far.parts.push_back({});
  far.parts.back().mesh = make_box(Box(Vec3(0, 0, 0), Vec3(500, 1, 1)));
  EXPECT_FALSE(scene_bytes(far).has_value());
  EXPECT_TRUE(scene_bytes(far, {1e-3}).has_value());
  EXPECT_FALSE(scene_bytes(far, {0.0}).has_value());
}

TEST(SceneFile, AnyDamageIsAnError) {
  const std::string whole = *scene_bytes(make_world(small_row(), 7));
  Rng rng(1, "damage");
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    char& byte = damaged[rng.index(damaged.size())];
    byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1 + rng.index(255)));
    EXPECT_FALSE(parse_scene(damaged).has_value());
  }
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(parse_scene(whole.substr(0, rng.index(whole.size()))).has_value());
  }
  EXPECT_FALSE(parse_scene(whole + "x").has_value());
  EXPECT_FALSE(parse_scene("").has_value());
}

/// What is packed in a file.
std::string content_of(std::string_view file) {
  const std::string_view packed = file.substr(scene_format::kHeaderBytes);
  std::string content(ZSTD_getFrameContentSize(packed.data(), packed.size()), '\0');
  ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
  return content;
}

/// What is behind the checksum is read with the same care.
TEST(SceneFile, WrongContentWithARightChecksumIsAnErrorToo) {
  Scene tiny;
  tiny.parts.push_back(painted_part());
  tiny.parts.push_back({});
  tiny.parts.back().mesh = make_box(Box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  tiny.parts.back().kind = PartClass::fruit;
  tiny.parts.back().fruit = 0;
  tiny.fruits.emplace_back();
  const std::string bytes = *scene_bytes(tiny);
  ASSERT_TRUE(parse_scene(bytes).has_value());
  Rng rng(2, "content");
  int sound = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string content;
    const std::size_t size = rng.index(400);
    for (std::size_t k = 0; k < size; ++k) content.push_back(static_cast<char>(rng.index(256)));
    sound += parse_scene(scene_format::around(content)).has_value();
  }
  EXPECT_EQ(sound, 0);
  // A sound content with single bytes changed: an error, or another scene.
  const std::string content = content_of(bytes);
  ASSERT_TRUE(parse_scene(scene_format::around(content)).has_value());
  for (int i = 0; i < 5000; ++i) {
    std::string changed = content;
    for (std::size_t k = 0; k <= rng.index(3); ++k) {
      changed[rng.index(changed.size())] = static_cast<char>(rng.index(256));
    }
    if (rng.chance(0.1)) changed.resize(rng.index(changed.size()));
    const auto scene = parse_scene(scene_format::around(changed));
    if (!scene) continue;
    for (const ScenePart& part : scene->parts) {
      EXPECT_LT(part.fruit, static_cast<int>(scene->fruits.size()));
      for (const auto& t : part.mesh.triangles) {
        for (const std::uint32_t index : t) ASSERT_LT(index, part.mesh.vertices.size());
      }
    }
  }
  tiny.fruits.clear();  // the part is of no fruit any more
  const auto orphan = parse_scene(*scene_bytes(tiny));
  ASSERT_FALSE(orphan.has_value());
  EXPECT_NE(orphan.error().message.find("fruit"), std::string::npos);
}

TEST(ByteTaker, NumbersComeBack) {
  std::string bytes;
  const std::vector<std::int64_t> numbers = {0,         -1,       1, 63, -64, 64, 1'000'000'007,
                                             INT64_MIN, INT64_MAX};
  for (const std::int64_t x : numbers) append_signed(bytes, x);
  append_varint(bytes, UINT64_MAX);
  ByteTaker taker(bytes);
  for (const std::int64_t x : numbers) EXPECT_EQ(taker.signed_varint(), x);
  EXPECT_EQ(taker.varint(), UINT64_MAX);
  EXPECT_TRUE(taker.ok());
  EXPECT_EQ(taker.number<double>(), 0.0);
  EXPECT_FALSE(taker.ok());
}

/// On a flat grid every inner vertex is the fourth corner of a parallelogram.
TEST(VertexPredictor, IsExactOnAFlatGrid) {
  constexpr std::uint32_t kSide = 5;
  Topology topology{kSide * kSide, {}};
  std::vector<GridPoint> points;
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (std::uint32_t k = 0; k < kSide; ++k) {
      points.push_back({10 * i + 3 * k, 2 * i - 7 * k + 100, 4 * i + k});
      if (i == 0 || k == 0) continue;
      const std::uint32_t d = i * kSide + k;
      topology.triangles.push_back({d - kSide - 1, d - 1, d});
      topology.triangles.push_back({d - kSide - 1, d, d - kSide});
    }
  }
  const VertexPredictor predictor(topology);
  for (std::uint32_t i = 1; i < kSide; ++i) {
    for (std::uint32_t k = 1; k < kSide; ++k) {
      const std::size_t index = i * kSide + k;
      EXPECT_EQ(predictor.expected(index, points, {}), points[index]);
    }
  }
}

TEST(PackedNormal, IsWithinADegree) {
  Rng rng(3, "normals");
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3f n =
        Vec3{rng.normal(), rng.normal(), rng.normal()}.normalized().cast<float>();
    const auto back = unpack_normal(pack_normal({n.x(), n.y(), n.z()}));
    EXPECT_GT(n.dot(Eigen::Vector3f(back[0], back[1], back[2])), 0.99985);
  }
}

}  // namespace
}  // namespace canopeer
