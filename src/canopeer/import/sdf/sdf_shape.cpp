#include "canopeer/import/sdf/sdf_shape.h"

#include <algorithm>
#include <array>

#include "canopeer/import/sdf/extrusion.h"
#include "canopeer/import/sdf/sdf_file.h"
#include "canopeer/import/sdf/sdf_numbers.h"
#include "canopeer/import/shape_mesh.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastUnseen = 0.5;  // transparency from which a camera looks through

struct NamedColor {
  const char* script;
  Rgb color;
};

/// The material scripts that come with Gazebo and are in common use.
constexpr std::array kGazeboColors = {
    NamedColor{"Gazebo/Red", {255, 0, 0}},      NamedColor{"Gazebo/Green", {0, 255, 0}},
    NamedColor{"Gazebo/Blue", {0, 0, 255}},     NamedColor{"Gazebo/White", {255, 255, 255}},
    NamedColor{"Gazebo/Black", {0, 0, 0}},      NamedColor{"Gazebo/Grey", {178, 178, 178}},
    NamedColor{"Gazebo/Gray", {178, 178, 178}}, NamedColor{"Gazebo/DarkGrey", {45, 45, 45}},
    NamedColor{"Gazebo/Yellow", {255, 255, 0}}, NamedColor{"Gazebo/Orange", {255, 130, 9}},
    NamedColor{"Gazebo/Wood", {156, 112, 66}},  NamedColor{"Gazebo/Grass", {76, 112, 38}}};

Rgb to_rgb(const std::vector<double>& c) {
  const auto level = [](double x) {
    return static_cast<std::uint8_t>(std::clamp(static_cast<float>(x), 0.0F, 1.0F) * 255.0F + 0.5F);
  };
  return {level(c[0]), level(c[1]), level(c[2])};
}

/// The picture that gives the colours, by either workflow; empty: none.
std::string albedo_map(const SdfElement& material) {
  std::string map;
  for (const char* workflow : {"metal", "specular"}) {
    const std::string named = material.child("pbr").child(workflow).child("albedo_map").text();
    if (!named.empty()) map = named;
  }
  return map;
}

Expected<void> read_material(const SdfElement& material, const ModelPaths& paths, SdfVisual* visual,
                             std::vector<std::string>* notices) {
  if (!material) return {};
  SdfMaterial& result = visual->material;
  result.name = material.child("script").child("name").text();
  for (const NamedColor& known : kGazeboColors) {
    if (result.name == known.script) result.color = known.color;
  }
  // A script's colour stands in files Gazebo keeps; <diffuse> beside it has no say there, but is
  // better than nothing here.
  if (const SdfElement diffuse = material.child("diffuse"); !diffuse.text().empty()) {
    const auto color = sdf_numbers(diffuse, 3);
    if (!color) return tl::unexpected(color.error());
    if (!result.color) result.color = to_rgb(*color);
    const double alpha = color->size() > 3 ? (*color)[3] : 1.0;
    visual->see_through = visual->see_through || 1.0 - alpha >= kLeastUnseen;
  }
  const std::string map = albedo_map(material);
  if (map.empty()) return {};
  result.texture = paths.find(map, material.file().path().parent_path());
  if (!result.texture) {
    notices->push_back("texture " + map + ": not found; the <albedo_map> of " + visual->where +
                       " refers to it; going on without this texture");
  }
  return {};
}

/// False: it is not there.
Expected<bool> read_mesh(const SdfElement& mesh, const ModelPaths& paths, SdfVisual* visual,
                         MissingFiles* missing) {
  const std::string uri = mesh.child("uri").text();
  const fs::path folder = mesh.file().path().parent_path();
  const auto path = paths.find(uri, folder);
  if (!path) {
    missing->add(uri, Error{visual->where + ": <mesh><uri>" + uri + ": no such file; visual '" +
                            visual->names.visual + "' of model '" + visual->names.model +
                            "' refers to it (" + paths.searched(uri, folder) + ")"});
    return false;
  }
  const auto scale = sdf_vector(mesh, "scale", Vec3::Ones());
  if (!scale) return tl::unexpected(scale.error());
  visual->mesh = *path;
  visual->submesh = mesh.child("submesh").child("name").text();
  visual->center_submesh = sdf_truth(mesh.child("submesh").child("center").text());
  visual->T_world_visual.scale(*scale);
  return true;
}

/// Nothing: it is no outline, or not one alone (of several, the inner ones are holes).
Expected<std::optional<TriangleMesh>> polyline(const SdfElement& line, const SdfElement& geometry) {
  if (geometry.children("polyline").size() > 1) return std::nullopt;
  std::vector<Eigen::Vector2d> outline;
  for (const SdfElement& point : line.children("point")) {
    const auto p = sdf_numbers(point, 2);
    if (!p) return tl::unexpected(p.error());
    outline.emplace_back((*p)[0], (*p)[1]);
  }
  const auto height = sdf_number(line, "height", 1.0);
  if (!height) return tl::unexpected(height.error());
  return extruded_mesh(std::move(outline), *height);
}

Expected<std::optional<TriangleMesh>> plane(const SdfElement& shape) {
  const auto normal = sdf_vector(shape, "normal", Vec3::UnitZ());
  if (!normal) return tl::unexpected(normal.error());
  if (!(normal->norm() > 0.0)) {
    return fail(shape.child("normal").where() + ": <normal>: expected a direction");
  }
  std::vector<double> size = {1.0, 1.0};
  if (const SdfElement given = shape.child("size"); !given.text().empty()) {
    auto numbers = sdf_numbers(given, 2);
    if (!numbers) return tl::unexpected(numbers.error());
    size = std::move(*numbers);
  }
  return plane_mesh(normal->normalized(), size[0], size[1]);
}

/// A shape that has a length and is round about z.
using RoundMesh = TriangleMesh (*)(double radius_m, double length_m);

Expected<std::optional<TriangleMesh>> round(const SdfElement& shape, RoundMesh mesh) {
  const auto radius = sdf_number(shape, "radius", 1.0);
  if (!radius) return tl::unexpected(radius.error());
  const auto length = sdf_number(shape, "length", 1.0);
  if (!length) return tl::unexpected(length.error());
  return mesh(*radius, *length);
}

/// Nothing: no such primitive here.
Expected<std::optional<TriangleMesh>> primitive(const SdfElement& shape,
                                                const SdfElement& geometry) {
  const std::string_view kind = shape.tag();
  if (kind == "cylinder") return round(shape, cylinder_mesh);
  if (kind == "capsule") return round(shape, capsule_mesh);
  if (kind == "cone") return round(shape, cone_mesh);
  if (kind == "plane") return plane(shape);
  if (kind == "polyline") return polyline(shape, geometry);
  if (kind == "sphere") {
    const auto radius = sdf_number(shape, "radius", 1.0);
    if (!radius) return tl::unexpected(radius.error());
    return ellipsoid_mesh(Vec3::Constant(*radius));
  }
  const bool box = kind == "box";
  if (!box && kind != "ellipsoid") return std::nullopt;
  const auto size = sdf_vector(shape, box ? "size" : "radii", Vec3::Ones());
  if (!size) return tl::unexpected(size.error());
  return box ? box_mesh(*size) : ellipsoid_mesh(*size);
}

/// The first child that SDF knows as a shape, else the first.
SdfElement shape_in(const SdfElement& geometry) {
  for (const char* kind :
       {"mesh", "box", "sphere", "ellipsoid", "cylinder", "capsule", "cone", "plane", "polyline"}) {
    if (const SdfElement shape = geometry.child(kind)) return shape;
  }
  const auto children = geometry.children();
  return children.empty() ? SdfElement() : children.front();
}

}  // namespace

Expected<bool> read_sdf_shape(const SdfElement& from, const ModelPaths& paths, SdfVisual* visual,
                              std::vector<std::string>* notices, MissingFiles* missing) {
  visual->where = from.where();
  const SdfElement geometry = from.child("geometry");
  const SdfElement shape = shape_in(geometry);
  if (!shape || shape.tag() == "empty") return false;
  const auto transparency = sdf_number(from, "transparency", 0.0);
  if (!transparency) return tl::unexpected(transparency.error());
  visual->see_through = *transparency >= kLeastUnseen;
  auto painted = read_material(from.child("material"), paths, visual, notices);
  if (!painted) return tl::unexpected(painted.error());
  if (shape.tag() == "mesh") {
    return read_mesh(shape, paths, visual, missing);
  }
  auto mesh = primitive(shape, geometry);
  if (!mesh) return tl::unexpected(mesh.error());
  if (*mesh) {
    visual->primitive = std::move(**mesh);
    return true;
  }
  notices->push_back(visual->where + ": <" + std::string(shape.tag()) + ">: visual '" +
                     visual->names.visual + "' of model '" + visual->names.model +
                     "' is left out: expected a mesh, box, sphere, ellipsoid, cylinder, capsule, "
                     "cone, plane or one polyline");
  return false;
}

}  // namespace canopeer
