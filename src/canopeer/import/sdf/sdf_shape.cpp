#include "canopeer/import/sdf/sdf_shape.h"

#include <algorithm>
#include <array>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Geometry.hh>
#include <sdf/Material.hh>
#include <sdf/Mesh.hh>
#include <sdf/Pbr.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <sdf/Types.hh>
#include <sdf/Visual.hh>

#include "canopeer/import/sdf/extrusion.h"
#include "canopeer/import/sdf/sdf_convert.h"
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

Rgb to_rgb(const ignition::math::Color& c) {
  const auto level = [](float x) {
    return static_cast<std::uint8_t>(std::clamp(x, 0.0F, 1.0F) * 255.0F + 0.5F);
  };
  return {level(c.R()), level(c.G()), level(c.B())};
}

void read_material(const sdf::Visual& from, const ModelPaths& paths, const fs::path& folder,
                   SdfVisual* visual, std::vector<std::string>* notices) {
  const sdf::Material* const material = from.Material();
  if (material == nullptr) return;
  SdfMaterial& result = visual->material;
  result.name = material->ScriptName();
  for (const NamedColor& known : kGazeboColors) {
    if (result.name == known.script) result.color = known.color;
  }
  // A script's colour stands in files Gazebo keeps; <diffuse> beside it has no say there, but is
  // better than nothing here.
  if (material->Element() && material->Element()->HasElement("diffuse")) {
    if (!result.color) result.color = to_rgb(material->Diffuse());
    visual->see_through = visual->see_through || 1.0 - material->Diffuse().A() >= kLeastUnseen;
  }
  const sdf::Pbr* const pbr = material->PbrMaterial();
  if (pbr == nullptr) return;
  for (const auto type : {sdf::PbrWorkflowType::METAL, sdf::PbrWorkflowType::SPECULAR}) {
    const sdf::PbrWorkflow* const flow = pbr->Workflow(type);
    if (flow == nullptr || flow->AlbedoMap().empty()) continue;
    result.texture = paths.find(flow->AlbedoMap(), folder);
    if (!result.texture) {
      notices->push_back("texture " + flow->AlbedoMap() + ": not found; the <albedo_map> of " +
                         visual->where + " refers to it; going on without this texture");
    }
  }
}

Expected<void> read_mesh(const sdf::Mesh& mesh, const ModelPaths& paths, const fs::path& folder,
                         SdfVisual* visual) {
  const auto path = paths.find(mesh.Uri(), folder);
  if (!path) {
    return fail(visual->where + ": <mesh><uri>" + mesh.Uri() + ": no such file; visual '" +
                visual->names.visual + "' of model '" + visual->names.model + "' refers to it (" +
                paths.searched(mesh.Uri(), folder) + ")");
  }
  visual->mesh = *path;
  visual->submesh = mesh.Submesh();
  visual->center_submesh = mesh.CenterSubmesh();
  visual->T_world_visual.scale(to_vec3(mesh.Scale()));
  return {};
}

/// SDF's <polyline>, which the library passes on unread. False: there is none, or not one alone (of
/// several, the inner ones are holes), or it is no outline.
bool read_polyline(const sdf::Geometry& geometry, TriangleMesh* mesh) {
  const sdf::ElementPtr element = geometry.Element();
  if (!element || !element->HasElement("polyline")) return false;
  const sdf::ElementPtr line = element->GetElement("polyline");
  if (line->GetNextElement("polyline")) return false;
  std::vector<Eigen::Vector2d> outline;
  for (auto point = line->GetElement("point"); point; point = point->GetNextElement("point")) {
    const auto p = point->Get<ignition::math::Vector2d>();
    outline.emplace_back(p.X(), p.Y());
  }
  auto extruded = extruded_mesh(std::move(outline), line->Get<double>("height"));
  if (extruded) *mesh = std::move(*extruded);
  return extruded.has_value();
}

/// False: no such primitive here.
bool read_primitive(const sdf::Geometry& geometry, TriangleMesh* mesh) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      *mesh = box_mesh(to_vec3(geometry.BoxShape()->Size()));
      return true;
    case sdf::GeometryType::SPHERE:
      *mesh = ellipsoid_mesh(Vec3::Constant(geometry.SphereShape()->Radius()));
      return true;
    case sdf::GeometryType::ELLIPSOID:
      *mesh = ellipsoid_mesh(to_vec3(geometry.EllipsoidShape()->Radii()));
      return true;
    case sdf::GeometryType::CYLINDER:
      *mesh = cylinder_mesh(geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length());
      return true;
    case sdf::GeometryType::CAPSULE:
      *mesh = capsule_mesh(geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length());
      return true;
    case sdf::GeometryType::PLANE:
      *mesh = plane_mesh(to_vec3(geometry.PlaneShape()->Normal()),
                         geometry.PlaneShape()->Size().X(), geometry.PlaneShape()->Size().Y());
      return true;
    default:
      return read_polyline(geometry, mesh);
  }
}

/// The name of the element in <geometry>, for what cannot be shown; empty: there is none.
std::string shape_name(const sdf::Geometry& geometry) {
  const sdf::ElementPtr element = geometry.Element();
  const sdf::ElementPtr shape = element ? element->GetFirstElement() : nullptr;
  return shape && shape->GetName() != "empty" ? shape->GetName() : std::string();
}

}  // namespace

Expected<bool> read_sdf_shape(const sdf::Visual& from, const ModelPaths& paths,
                              const fs::path& default_file, SdfVisual* visual,
                              std::vector<std::string>* notices) {
  const sdf::Geometry* const geometry = from.Geom();
  fs::path file = default_file;
  if (from.Element() && !from.Element()->FilePath().empty() &&
      from.Element()->FilePath() != sdf::kSdfStringSource) {
    file = from.Element()->FilePath();
  }
  visual->where = file.string();
  if (from.Element() && from.Element()->FilePath() != sdf::kSdfStringSource &&
      from.Element()->LineNumber()) {
    visual->where += ":" + std::to_string(*from.Element()->LineNumber());
  }
  visual->see_through = from.Transparency() >= kLeastUnseen;
  if (geometry == nullptr) return false;
  read_material(from, paths, file.parent_path(), visual, notices);
  if (geometry->Type() == sdf::GeometryType::MESH) {
    auto ok = read_mesh(*geometry->MeshShape(), paths, file.parent_path(), visual);
    if (!ok) return tl::unexpected(ok.error());
    return true;
  }
  if (read_primitive(*geometry, &visual->primitive)) return true;
  const std::string shape = shape_name(*geometry);
  if (shape.empty()) return false;
  notices->push_back(visual->where + ": <" + shape + ">: visual '" + visual->names.visual +
                     "' of model '" + visual->names.model +
                     "' is left out: expected a mesh, box, sphere, ellipsoid, cylinder, capsule, "
                     "plane or one polyline");
  return false;
}

}  // namespace canopeer
