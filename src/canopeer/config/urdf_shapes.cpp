#include "canopeer/config/urdf_shapes.h"

#include <tinyxml2.h>
#include <urdf_model/pose.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include "canopeer/base/text_lines.h"
#include "canopeer/config/xml_lines.h"

namespace canopeer {
namespace {

/// Robots are smaller; what is larger was drawn in millimetres.
constexpr double kLargestMeshM = 20.0;

/// Farther or larger is no robot, and numbers of voxels would not hold it.
constexpr double kLargestM = 1e4;

/// Names shown of what is missing for one reason.
constexpr std::size_t kMeshesShown = 40;

/// The numbers an attribute holds; empty: another count than `count`, no numbers, or huge ones.
std::vector<double> numbers_of(const tinyxml2::XMLElement& element, const char* attribute,
                               std::size_t count) {
  const char* const text = element.Attribute(attribute);
  std::vector<double> numbers;
  for (std::string_view word : words_of(text == nullptr ? "" : text, " \t\r\n")) {
    if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
    const auto number = to_number(word);
    if (!number || !(std::abs(*number) <= kLargestM)) return {};
    numbers.push_back(*number);
  }
  return numbers.size() == count ? numbers : std::vector<double>{};
}

/// The element's <origin>; nothing: it cannot be read.
std::optional<Pose> origin_of(const tinyxml2::XMLElement& element) {
  const auto* const origin = element.FirstChildElement("origin");
  Pose T = Pose::Identity();
  if (origin == nullptr) return T;
  if (origin->Attribute("xyz") != nullptr) {
    const auto xyz = numbers_of(*origin, "xyz", 3);
    if (xyz.empty()) return std::nullopt;
    T.translation() = Vec3(xyz[0], xyz[1], xyz[2]);
  }
  if (origin->Attribute("rpy") != nullptr) {
    const auto rpy = numbers_of(*origin, "rpy", 3);
    if (rpy.empty()) return std::nullopt;
    urdf::Rotation turn;
    turn.setFromRPY(rpy[0], rpy[1], rpy[2]);
    T.linear() = Eigen::Quaterniond(turn.w, turn.x, turn.y, turn.z).normalized().toRotationMatrix();
  }
  return T;
}

/// "drake:capsule" is a capsule too.
std::string_view plain_name(const tinyxml2::XMLElement& element) {
  const std::string_view name = element.Name();
  const auto colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

bool is_shape(const tinyxml2::XMLElement& element) {
  const std::string_view name = plain_name(element);
  return name == "box" || name == "cylinder" || name == "sphere" || name == "capsule" ||
         name == "mesh";
}

Pose along_z(const Pose& T, double z) { return T * Eigen::Translation3d(0.0, 0.0, z); }

}  // namespace

std::string UrdfShapes::place(const tinyxml2::XMLElement& element) const {
  return xml_place(file_, &element) + ": link '" + link_ + "'";
}

void UrdfShapes::add(const tinyxml2::XMLElement& element, const std::string& what) {
  troubles_.push_back({what, place(element) + ":", {}, {}, ""});
}

std::vector<CollisionShape> UrdfShapes::read(const tinyxml2::XMLElement& link, const char* tag) {
  const char* const name = link.Attribute("name");
  link_ = name == nullptr ? "" : name;
  std::vector<CollisionShape> shapes;
  for (auto* element = link.FirstChildElement(tag); element != nullptr;
       element = element->NextSiblingElement(tag))
    read_one(*element, shapes);
  return shapes;
}

void UrdfShapes::read_one(const tinyxml2::XMLElement& element,
                          std::vector<CollisionShape>& shapes) {
  const auto* const geometry = element.FirstChildElement("geometry");
  const auto* child = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (child == nullptr) {
    notices_.push_back(place(element) + ": a <" + element.Name() + "> without a shape is left out");
    return;
  }
  const auto* shape = child;
  while (shape != nullptr && !is_shape(*shape)) shape = shape->NextSiblingElement();
  if (shape == nullptr) {
    return add(*child, "<" + std::string(child->Name()) +
                           "> is no shape; expected box, cylinder, sphere, capsule or mesh");
  }
  const auto T = origin_of(element);
  if (!T) return add(element, "the <origin> needs three numbers in xyz and three in rpy");
  const std::string_view kind = plain_name(*shape);
  if (kind == "mesh") return read_mesh(*shape, *T, shapes);

  std::vector<double> size;
  const char* wanted = "three numbers in size";
  if (kind == "box") {
    size = numbers_of(*shape, "size", 3);
  } else {
    size = numbers_of(*shape, "radius", 1);
    wanted = "a number in radius";
    if (kind != "sphere") {
      const auto length = numbers_of(*shape, "length", 1);
      wanted = "numbers in radius and length";
      size.insert(size.end(), length.begin(), length.end());
      if (size.size() != 2) size.clear();
    }
  }
  if (size.empty() || *std::min_element(size.begin(), size.end()) < 0.0)
    return add(*shape, "<" + std::string(kind) + "> needs " + wanted + ", none below 0");
  if (kind == "capsule") {
    if (size[0] > 0.0 && size[1] > 0.0)
      shapes.push_back(CollisionShape::cylinder(size[0], size[1], *T));
    for (const double end : {-0.5, 0.5}) {
      if (size[0] > 0.0 && (size[1] > 0.0 || end > 0.0))
        shapes.push_back(CollisionShape::sphere(size[0], along_z(*T, end * size[1])));
    }
    if (size[0] > 0.0) return;
  } else if (*std::min_element(size.begin(), size.end()) > 0.0) {
    shapes.push_back(kind == "box"      ? CollisionShape::box({size[0], size[1], size[2]}, *T)
                     : kind == "sphere" ? CollisionShape::sphere(size[0], *T)
                                        : CollisionShape::cylinder(size[0], size[1], *T));
    return;
  }
  notices_.push_back(place(*shape) + ": a <" + std::string(kind) + "> of no size is left out");
}

void UrdfShapes::read_mesh(const tinyxml2::XMLElement& mesh, const Pose& T_link_shape,
                           std::vector<CollisionShape>& shapes) {
  const char* const name = mesh.Attribute("filename");
  if (name == nullptr || *name == '\0') return add(mesh, "<mesh> needs a filename");
  Vec3 scale = Vec3::Ones();
  if (mesh.Attribute("scale") != nullptr) {
    const auto given = numbers_of(mesh, "scale", 3);
    if (given.empty()) return add(mesh, "<mesh> needs three numbers in scale");
    scale = Vec3(given[0], given[1], given[2]);
  }
  auto shape = meshes_->load(name, scale, T_link_shape);
  if (shape) {
    const double across = shape->size_m.maxCoeff();
    if (across > kLargestMeshM) {
      char text[96];
      std::snprintf(text, sizeof text, " is %.0f m across: in millimetres? Give it scale=\"%s\"",
                    across, "0.001 0.001 0.001");
      notices_.push_back(place(mesh) + ": mesh '" + name + "'" + text);
    }
    shapes.push_back(std::move(*shape));
    return;
  }
  const MeshTrouble& trouble = shape.error();
  auto same = std::find_if(troubles_.begin(), troubles_.end(),
                           [&](const Trouble& known) { return known.what == trouble.what; });
  if (same == troubles_.end()) {
    const std::string first = place(mesh) + ": mesh '" + name + "'";
    troubles_.push_back({trouble.what, first, {name}, {}, trouble.near});
    return;
  }
  if (std::find(same->meshes.begin(), same->meshes.end(), name) != same->meshes.end()) return;
  same->meshes.emplace_back(name);
  if (same->meshes.size() > kMeshesShown) return;
  same->further.push_back(std::to_string(mesh.GetLineNum()) + " '" + name + "'" +
                          (trouble.near.empty() ? "" : " (there is " + trouble.near + ")"));
}

std::vector<std::string> UrdfShapes::troubles() const {
  std::vector<std::string> lines;
  for (const Trouble& trouble : troubles_) {
    std::string line = trouble.first + " " + trouble.what;
    if (!trouble.near.empty()) line += "; there is " + trouble.near;
    if (!trouble.further.empty()) {
      line += "; " + std::to_string(trouble.meshes.size() - 1) + " more, in line ";
      for (std::size_t i = 0; i < trouble.further.size(); ++i)
        line += (i == 0 ? "" : ", ") + trouble.further[i];
      if (trouble.meshes.size() > kMeshesShown) line += ", …";
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace canopeer
