#include <zstd.h>

#include <cmath>

#include "canopeer/base/atomic_file.h"
#include "canopeer/scene/files/mesh_code.h"
#include "canopeer/scene/files/scene_format.h"
#include "canopeer/scene/scene_file.h"

namespace canopeer {
namespace {

using namespace scene_format;

constexpr char kCopyAgain[] = "; the file was damaged: copy it again";
constexpr std::uint64_t kMostFruits = 32767;  // their numbers are 16 bits wide in label images
constexpr std::uint64_t kMostPixels = 1U << 26U;
constexpr std::int64_t kMostPlants = 1'000'000;

struct SharedTopology {
  Topology topology;
  VertexPredictor predictor;
};

class SceneReader {
 public:
  explicit SceneReader(std::string_view content)
      : all_(content), table_(all_.text()), texture_count_(all_.number<std::uint32_t>()) {
    ByteTaker textures(all_.text());
    for (std::uint32_t i = 0; i < texture_count_ && textures.ok(); ++i) take_texture(textures);
    const auto topologies = all_.number<std::uint32_t>();
    ByteTaker indices(all_.text());
    std::uint64_t vertices = 0;
    for (std::uint32_t i = 0; i < topologies && indices.ok(); ++i) {
      Topology topology = take_topology(indices, kMostTriangles);
      // Each is used, and a vertex takes three bytes at least.
      vertices += topology.vertices;
      if (!indices.ok() || vertices > content.size()) break;
      VertexPredictor predictor(topology);
      topologies_.push_back({std::move(topology), std::move(predictor)});
    }
    good_ = textures.ok() && indices.ok() && topologies_.size() == topologies &&
            textures.left() == 0 && indices.left() == 0;
    for (ByteTaker& axis : axes_) axis = ByteTaker(all_.text());
    raw_ = ByteTaker(all_.text());
  }

  Expected<Scene> scene() {
    if (!good_ || !all_.ok()) return fail("the tables of a scene file do not hold together");
    Scene scene;
    grid_m_ = table_.number<double>();
    scene.name = take_name(table_);
    scene.seed = table_.number<std::uint64_t>();
    scene.imported = table_.number<std::uint8_t>() != 0;
    scene.ground_m2 = positive(table_);
    need(grid_m_ >= 1e-6 && grid_m_ <= 0.01);
    take_parts(scene.parts);
    const std::uint64_t models = table_.bounded(table_.left());
    for (std::uint64_t i = 0; i < models && sound(); ++i)
      take_parts(scene.models.emplace_back().parts);
    take_instances(scene);
    take_fruits(scene);
    if (!sound()) return fail("what a scene file holds makes no scene");
    if (table_.left() + raw_.left() + axes_[0].left() + axes_[1].left() + axes_[2].left() > 0) {
      return fail("a scene file holds more than its scene");
    }
    if (!references_hold(scene)) return fail("the parts of a scene file belong to no fruit of it");
    return scene;
  }

 private:
  void need(bool condition) { good_ = good_ && condition; }
  [[nodiscard]] bool sound() const {
    return good_ && table_.ok() && raw_.ok() && axes_[0].ok() && axes_[1].ok() && axes_[2].ok();
  }

  double finite(ByteTaker& taker) {
    const auto x = taker.number<double>();
    need(std::isfinite(x) && std::abs(x) < 1e9);
    return x;
  }
  double positive(ByteTaker& taker) {
    const double x = finite(taker);
    need(x >= 0.0);
    return x;
  }
  int plant(ByteTaker& taker) {
    const std::int64_t index = taker.signed_varint();
    need(index >= -1 && index < kMostPlants);
    return good_ ? static_cast<int>(index) : -1;
  }
  int fruit(ByteTaker& taker) {
    const std::int64_t index = taker.signed_varint();
    need(index >= -1 && index < static_cast<std::int64_t>(kMostFruits));
    return good_ ? static_cast<int>(index) : -1;
  }
  static Rgb take_color(ByteTaker& taker) {
    Rgb color;
    color.r = taker.number<std::uint8_t>();
    color.g = taker.number<std::uint8_t>();
    color.b = taker.number<std::uint8_t>();
    return color;
  }
  /// Names stand in reports and tables: nothing that such a text cannot hold.
  std::string take_name(ByteTaker& taker) {
    std::string name(taker.text());
    for (char& c : name) {
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E) c = '_';
    }
    return name;
  }

  void take_texture(ByteTaker& taker) {
    auto texture = std::make_shared<Texture>();
    texture->name = take_name(taker);
    std::uint64_t side[4];
    for (std::uint64_t& pixels : side) pixels = taker.bounded(1U << 16U);
    texture->cut_below = taker.number<std::uint8_t>();
    const std::uint64_t colors = side[0] * side[1];
    const std::uint64_t levels = side[2] * side[3];
    if (colors > kMostPixels || levels > kMostPixels || colors * 3 + levels > taker.left()) {
      taker.take(taker.left() + 1);
      return;
    }
    texture->color = ColorImage(static_cast<int>(side[0]), static_cast<int>(side[1]));
    for (Rgb& color : texture->color.pixels()) color = take_color(taker);
    texture->opacity = Image<std::uint8_t>(static_cast<int>(side[2]), static_cast<int>(side[3]));
    for (std::uint8_t& level : texture->opacity.pixels()) level = taker.number<std::uint8_t>();
    textures_.push_back(std::move(texture));
  }

  void take_parts(std::vector<ScenePart>& parts) {
    const std::uint64_t count = table_.bounded(table_.left());
    for (std::uint64_t i = 0; i < count && sound(); ++i) take_part(parts.emplace_back());
  }

  void take_part(ScenePart& part) {
    const auto kind = table_.number<std::uint8_t>();
    const auto flags = table_.number<std::uint8_t>();
    need(kind <= static_cast<std::uint8_t>(PartClass::support) && flags <= kAllFlags);
    part.kind = static_cast<PartClass>(kind);
    part.see_through = (flags & kSeeThrough) != 0;
    part.plant = plant(table_);
    part.fruit = fruit(table_);
    need((part.kind == PartClass::fruit) == (part.fruit >= 0));
    part.color = take_color(table_);
    if ((flags & kTextured) != 0) {
      const std::uint64_t texture = table_.varint();
      need(texture < textures_.size());
      if (good_) part.texture = textures_[static_cast<std::size_t>(texture)];
    }
    const std::uint64_t topology = table_.varint();
    need(topology < topologies_.size());
    if (sound()) take_mesh(topologies_[static_cast<std::size_t>(topology)], flags, part);
  }

  void take_mesh(const SharedTopology& shared, unsigned flags, ScenePart& part) {
    const std::size_t count = shared.topology.vertices;
    triangles_ += shared.topology.triangles.size();
    need(triangles_ <= kMostTriangles && count <= axes_[0].left());
    if (!sound()) return;
    TriangleMesh& mesh = part.mesh;
    if ((flags & kOwnNormals) != 0) take_normals(count, mesh);
    for (std::size_t i = 0; (flags & kVertexColors) != 0 && i < count && raw_.ok(); ++i) {
      part.vertex_colors.push_back(take_color(raw_));
    }
    for (std::size_t i = 0; (flags & kTextured) != 0 && i < count && raw_.ok(); ++i) {
      const auto u = raw_.number<float>();
      const auto v = raw_.number<float>();
      need(std::abs(u) < 1e6F && std::abs(v) < 1e6F);
      part.uv.emplace_back(u, v);
    }
    take_vertices(shared, mesh);
    mesh.triangles = shared.topology.triangles;
    if (sound() && (flags & (kOwnNormals | kNoNormals)) == 0) compute_normals(mesh);
  }

  void take_normals(std::size_t count, TriangleMesh& mesh) {
    for (std::size_t i = 0; i < count && raw_.ok(); ++i) {
      PackedNormal packed{};
      for (std::int8_t& level : packed) level = raw_.number<std::int8_t>();
      const auto n = unpack_normal(packed);
      mesh.normals.emplace_back(n[0], n[1], n[2]);
    }
  }

  void take_vertices(const SharedTopology& shared, TriangleMesh& mesh) {
    points_.clear();
    for (std::size_t k = 0; k < shared.topology.vertices && sound(); ++k) {
      GridPoint point = shared.predictor.expected(k, points_, last_);
      Eigen::Vector3f vertex;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t step = axes_[i].signed_varint();
        need(step >= -8 * kMostSteps && step <= 8 * kMostSteps);
        if (!good_) return;
        point[i] += step;
        need(point[i] >= -kMostSteps && point[i] <= kMostSteps);
        vertex[static_cast<int>(i)] = static_cast<float>(static_cast<double>(point[i]) * grid_m_);
      }
      points_.push_back(point);
      mesh.vertices.push_back(vertex);
    }
    if (!points_.empty()) last_ = points_.back();
  }

  void take_instances(Scene& scene) {
    const std::uint64_t count = table_.bounded(table_.left());
    for (std::uint64_t k = 0; k < count && sound(); ++k) {
      SceneInstance copy;
      copy.model = static_cast<std::size_t>(table_.varint());
      need(copy.model < scene.models.size());
      copy.plant = plant(table_);
      copy.first_fruit = fruit(table_);
      copy.brightness = table_.number<float>();
      need(copy.brightness >= 0.0F && copy.brightness < 100.0F);
      for (int i = 0; i < 12; ++i) copy.T_world_model.matrix()(i / 4, i % 4) = finite(table_);
      const Eigen::Matrix3d R = copy.T_world_model.linear();
      need((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-6);
      scene.instances.push_back(copy);
    }
  }

  void take_fruits(Scene& scene) {
    const std::uint64_t count = table_.bounded(kMostFruits);
    for (std::uint64_t k = 0; k < count && sound(); ++k) {
      FruitTruth fruit;
      fruit.id = static_cast<int>(k);
      const auto ripeness = table_.number<std::uint8_t>();
      need(ripeness <= static_cast<std::uint8_t>(Ripeness::ripe));
      fruit.ripeness = static_cast<Ripeness>(ripeness);
      fruit.counted = table_.number<std::uint8_t>() != 0;
      fruit.plant = plant(table_);
      for (int i = 0; i < 3; ++i) fruit.centre[i] = finite(table_);
      for (double* x :
           {&fruit.length_m, &fruit.diameter_m, &fruit.volume_cm3, &fruit.surface_cm2}) {
        *x = positive(table_);
      }
      fruit.model = take_name(table_);
      scene.fruits.push_back(std::move(fruit));
    }
  }

  /// Every part of a fruit is of one that is there.
  static bool references_hold(const Scene& scene) {
    const auto count = static_cast<int>(scene.fruits.size());
    for (const ScenePart& part : scene.parts) {
      if (part.fruit >= count) return false;
    }
    for (const SceneInstance& copy : scene.instances) {
      for (const ScenePart& part : scene.models[copy.model].parts) {
        if (part.fruit >= 0 && (copy.first_fruit < 0 || copy.first_fruit + part.fruit >= count)) {
          return false;
        }
      }
    }
    return true;
  }

  ByteTaker all_;
  ByteTaker table_;
  std::uint32_t texture_count_;
  std::vector<std::shared_ptr<const Texture>> textures_;
  std::vector<SharedTopology> topologies_;
  std::array<ByteTaker, 3> axes_ = {ByteTaker(std::string_view()), ByteTaker(std::string_view()),
                                    ByteTaker(std::string_view())};
  ByteTaker raw_{std::string_view()};
  std::uint64_t triangles_ = 0;
  double grid_m_ = 0.0;
  GridPoint last_{};
  std::vector<GridPoint> points_;
  bool good_ = true;
};

}  // namespace

Expected<Scene> parse_scene(std::string_view bytes) {
  if (!bytes.starts_with(kMagic)) return fail("is no scene file (.cscene): it begins otherwise");
  if (bytes.size() < kHeaderBytes) return fail("ends within its header: cut off");
  ByteTaker taker(bytes.substr(kMagic.size()));
  const auto version = taker.number<std::uint32_t>();
  if (version != kVersion) {
    return fail("has format version " + std::to_string(version) + ", this program reads version " +
                std::to_string(kVersion));
  }
  const auto unpacked = taker.number<std::uint32_t>();
  const auto sum = taker.number<std::uint32_t>();
  const std::string_view packed = bytes.substr(kHeaderBytes);
  if (sum != checksum(bytes.substr(kMagic.size(), 8), packed)) {
    return fail("its checksum is wrong" + std::string(kCopyAgain));
  }
  if (unpacked > kMostUnpacked ||
      ZSTD_getFrameContentSize(packed.data(), packed.size()) != unpacked) {
    return fail("states an impossible size" + std::string(kCopyAgain));
  }
  std::string content(unpacked, '\0');
  if (ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size()) != unpacked) {
    return fail("cannot be decompressed" + std::string(kCopyAgain));
  }
  return SceneReader(content).scene();
}

Expected<Scene> read_scene_file(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto scene = parse_scene(*bytes);
  if (!scene) return fail_in(path.string(), scene.error());
  return scene;
}

}  // namespace canopeer
