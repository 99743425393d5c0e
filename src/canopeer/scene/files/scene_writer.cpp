#include <algorithm>
#include <cmath>
#include <map>

#include "canopeer/base/atomic_file.h"
#include "canopeer/scene/files/mesh_code.h"
#include "canopeer/scene/files/scene_format.h"
#include "canopeer/scene/scene_file.h"

namespace canopeer {
namespace {

using namespace scene_format;

/// Normals that differ by more than 3° from those of the surface are the mesh's own: smooth ones
/// over a seam, say.
bool has_own_normals(const TriangleMesh& mesh) {
  constexpr float kSameCosine = 0.9986F;
  TriangleMesh derived = mesh;
  compute_normals(derived);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (mesh.normals[i].dot(derived.normals[i]) < kSameCosine) return true;
  }
  return false;
}

class SceneWriter {
 public:
  SceneWriter(const Scene& scene, double grid_m) : scene_(scene), grid_m_(grid_m) {}

  Expected<std::string> content() {
    append_number(table_, grid_m_);
    append_text(table_, scene_.name);
    append_number(table_, scene_.seed);
    append_number(table_, static_cast<std::uint8_t>(scene_.imported));
    append_number(table_, scene_.ground_m2);
    if (auto ok = add_parts(scene_.parts); !ok) return tl::unexpected(ok.error());
    append_varint(table_, scene_.models.size());
    for (const SceneModel& model : scene_.models) {
      if (auto ok = add_parts(model.parts); !ok) return tl::unexpected(ok.error());
    }
    add_instances();
    add_fruits();
    std::string all;
    append_text(all, table_);
    append_number(all, static_cast<std::uint32_t>(textures_.size()));
    append_text(all, texture_table_);
    append_number(all, static_cast<std::uint32_t>(topologies_.size()));
    append_text(all, topology_table_);
    for (const std::string& axis : axes_) append_text(all, axis);
    append_text(all, raw_);
    if (all.size() > kMostUnpacked) return fail("the scene is too large for a scene file");
    return all;
  }

 private:
  Expected<void> add_parts(const std::vector<ScenePart>& parts) {
    append_varint(table_, parts.size());
    for (const ScenePart& part : parts) {
      if (auto ok = add_part(part); !ok) return ok;
    }
    return {};
  }

  Expected<void> add_part(const ScenePart& part) {
    const std::size_t count = part.mesh.vertices.size();
    unsigned flags = part.see_through ? kSeeThrough : 0U;
    if (!part.vertex_colors.empty() && part.vertex_colors.size() == count) flags |= kVertexColors;
    if (part.texture != nullptr && part.uv.size() == count) flags |= kTextured;
    if (part.mesh.normals.empty()) {
      flags |= kNoNormals;
    } else if (has_own_normals(part.mesh)) {
      flags |= kOwnNormals;
    }
    append_number(table_, static_cast<std::uint8_t>(part.kind));
    append_number(table_, static_cast<std::uint8_t>(flags));
    append_signed(table_, part.plant);
    append_signed(table_, part.fruit);
    add_color(part.color, table_);
    if ((flags & kTextured) != 0) append_varint(table_, texture_index(part.texture));
    if ((flags & kOwnNormals) != 0) {
      for (const auto& n : part.mesh.normals) {
        for (const std::int8_t level : pack_normal({n.x(), n.y(), n.z()})) {
          append_number(raw_, level);
        }
      }
    }
    if ((flags & kVertexColors) != 0) {
      for (const Rgb& color : part.vertex_colors) add_color(color, raw_);
    }
    if ((flags & kTextured) != 0) {
      for (const auto& uv : part.uv) {
        append_number(raw_, uv.x());
        append_number(raw_, uv.y());
      }
    }
    return add_mesh(part.mesh);
  }

  Expected<void> add_mesh(const TriangleMesh& mesh) {
    Topology topology{static_cast<std::uint32_t>(mesh.vertices.size()), mesh.triangles};
    std::string bytes;
    append_topology(bytes, topology);
    auto [known, is_new] =
        topologies_.try_emplace(bytes, Known{topologies_.size(), VertexPredictor(topology)});
    if (is_new) topology_table_ += bytes;
    append_varint(table_, known->second.index);
    std::vector<GridPoint> points;
    for (const auto& v : mesh.vertices) {
      const GridPoint expected = known->second.predictor.expected(points.size(), points, last_);
      GridPoint point{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double steps = std::round(static_cast<double>(v[static_cast<int>(i)]) / grid_m_);
        if (!(std::abs(steps) <= static_cast<double>(kMostSteps))) {
          return fail("the scene reaches farther than a scene file with a grid of " +
                      std::to_string(grid_m_ * 1e3) + " mm can say; leave that part out");
        }
        point[i] = static_cast<std::int64_t>(steps);
        append_signed(axes_[i], point[i] - expected[i]);
      }
      points.push_back(point);
    }
    if (!points.empty()) last_ = points.back();
    return {};
  }

  std::size_t texture_index(const std::shared_ptr<const Texture>& texture) {
    const auto [known, is_new] = textures_.try_emplace(texture.get(), textures_.size());
    if (!is_new) return known->second;
    // Without the folder it once lay in.
    append_text(texture_table_, std::filesystem::path(texture->name).filename().string());
    append_varint(texture_table_, static_cast<std::uint64_t>(texture->color.width()));
    append_varint(texture_table_, static_cast<std::uint64_t>(texture->color.height()));
    append_varint(texture_table_, static_cast<std::uint64_t>(texture->opacity.width()));
    append_varint(texture_table_, static_cast<std::uint64_t>(texture->opacity.height()));
    append_number(texture_table_, texture->cut_below);
    for (const Rgb& color : texture->color.pixels()) add_color(color, texture_table_);
    for (const std::uint8_t level : texture->opacity.pixels()) {
      append_number(texture_table_, level);
    }
    return known->second;
  }

  void add_instances() {
    append_varint(table_, scene_.instances.size());
    for (const SceneInstance& copy : scene_.instances) {
      append_varint(table_, copy.model);
      append_signed(table_, copy.plant);
      append_signed(table_, copy.first_fruit);
      append_number(table_, copy.brightness);
      for (int i = 0; i < 12; ++i) append_number(table_, copy.T_world_model.matrix()(i / 4, i % 4));
    }
  }

  void add_fruits() {
    append_varint(table_, scene_.fruits.size());
    for (const FruitTruth& fruit : scene_.fruits) {
      append_number(table_, static_cast<std::uint8_t>(fruit.ripeness));
      append_number(table_, static_cast<std::uint8_t>(fruit.counted));
      append_signed(table_, fruit.plant);
      for (int i = 0; i < 3; ++i) append_number(table_, fruit.centre[i]);
      for (const double x :
           {fruit.length_m, fruit.diameter_m, fruit.volume_cm3, fruit.surface_cm2}) {
        append_number(table_, x);
      }
      append_text(table_, fruit.model);
    }
  }

  static void add_color(Rgb color, std::string& bytes) {
    for (const std::uint8_t level : {color.r, color.g, color.b}) append_number(bytes, level);
  }

  struct Known {
    std::size_t index;
    VertexPredictor predictor;
  };
  const Scene& scene_;
  double grid_m_;
  std::string table_, texture_table_, topology_table_, raw_;
  std::array<std::string, 3> axes_;
  std::map<const Texture*, std::size_t> textures_;
  std::map<std::string, Known> topologies_;
  GridPoint last_{};
};

}  // namespace

Expected<std::string> scene_bytes(const Scene& scene, const SceneFileOptions& options) {
  if (!(options.grid_m >= 1e-6 && options.grid_m <= 0.01)) {
    return fail("the grid of a scene file must lie within 0.001 … 10 mm");
  }
  auto content = SceneWriter(scene, options.grid_m).content();
  if (!content) return content;
  return around(*content);
}

Expected<void> write_scene_file(const std::filesystem::path& path, const Scene& scene,
                                const SceneFileOptions& options) {
  const auto bytes = scene_bytes(scene, options);
  if (!bytes) return fail_in(path.string(), bytes.error());
  return write_file(path, *bytes);
}

}  // namespace canopeer
