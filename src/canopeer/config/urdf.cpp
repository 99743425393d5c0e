#include "canopeer/config/urdf.h"

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <mutex>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/urdf_joints.h"
#include "canopeer/config/xml_lines.h"

namespace canopeer {
namespace {

/// Keeps what urdfdom would print.
class Captured : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) messages_.push_back(text);
  }
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

urdf::ModelInterfaceSharedPtr parse_quietly(const std::string& xml, Captured& captured) {
  // console_bridge has one output handler per process.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  console_bridge::useOutputHandler(&captured);
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(xml);
  } catch (const std::exception& error) {
    captured.log(error.what(), console_bridge::CONSOLE_BRIDGE_LOG_ERROR, "", 0);
  }
  console_bridge::restorePreviousOutputHandler();
  return model;
}

/// The place of the first link or joint the messages name; the whole file when they name none.
std::string place_of(const std::vector<std::string>& messages, const std::string& name,
                     const tinyxml2::XMLDocument& document) {
  for (const std::string& message : messages) {
    for (const char* tag : {"joint", "link"}) {
      for (auto* element = document.RootElement()->FirstChildElement(tag); element != nullptr;
           element = element->NextSiblingElement(tag)) {
        const char* named = element->Attribute("name");
        if (named == nullptr) continue;
        for (const std::string& quoted :
             {'[' + std::string(named) + ']', '\'' + std::string(named) + '\'',
              '"' + std::string(named) + '"'}) {
          if (message.find(quoted) != std::string::npos) return xml_place(name, element);
        }
      }
    }
  }
  return name;
}

Pose to_pose(const urdf::Pose& pose) {
  Pose T = Pose::Identity();
  T.linear() =
      Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
          .normalized()
          .toRotationMatrix();
  T.translation() = Vec3(pose.position.x, pose.position.y, pose.position.z);
  return T;
}

Expected<CollisionShape> to_shape(const urdf::GeometrySharedPtr& geometry, const urdf::Pose& origin,
                                  const MeshSearch& search) {
  const Pose T = to_pose(origin);
  if (geometry == nullptr) return fail("a shape without geometry");
  Expected<CollisionShape> shape = fail("unknown geometry");
  switch (geometry->type) {
    case urdf::Geometry::BOX: {
      const auto& box = dynamic_cast<const urdf::Box&>(*geometry);
      shape = CollisionShape::box({box.dim.x, box.dim.y, box.dim.z}, T);
      break;
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(*geometry);
      shape = CollisionShape::cylinder(cylinder.radius, cylinder.length, T);
      break;
    }
    case urdf::Geometry::SPHERE:
      shape = CollisionShape::sphere(dynamic_cast<const urdf::Sphere&>(*geometry).radius, T);
      break;
    case urdf::Geometry::MESH: {
      const auto& mesh = dynamic_cast<const urdf::Mesh&>(*geometry);
      return load_mesh_shape(mesh.filename, {mesh.scale.x, mesh.scale.y, mesh.scale.z}, T, search);
    }
  }
  if (shape && !(shape->size_m.minCoeff() > 0.0)) return fail("a shape without size");
  return shape;
}

/// Some write a box of no size where there is nothing to run into.
bool is_nothing(const urdf::GeometrySharedPtr& geometry) {
  const auto* const box = dynamic_cast<const urdf::Box*>(geometry.get());
  const auto* const sphere = dynamic_cast<const urdf::Sphere*>(geometry.get());
  const auto* const cylinder = dynamic_cast<const urdf::Cylinder*>(geometry.get());
  return (box != nullptr && box->dim.x == 0.0 && box->dim.y == 0.0 && box->dim.z == 0.0) ||
         (sphere != nullptr && sphere->radius == 0.0) ||
         (cylinder != nullptr && cylinder->radius == 0.0 && cylinder->length == 0.0);
}

Expected<Link> to_link(const urdf::Link& from, const MeshSearch& search,
                       std::vector<std::string>& notices) {
  Link link;
  link.name = from.name;
  for (const auto& collision : from.collision_array) {
    if (is_nothing(collision->geometry)) {
      notices.push_back("link '" + link.name + "', collision: a shape of no size is left out");
      continue;
    }
    auto shape = to_shape(collision->geometry, collision->origin, search);
    if (!shape) return fail(shape.error().message);
    link.collision.push_back(std::move(*shape));
  }
  for (const auto& visual : from.visual_array) {
    if (is_nothing(visual->geometry)) continue;
    auto shape = to_shape(visual->geometry, visual->origin, search);
    if (shape) {
      link.visual.push_back(std::move(*shape));
    } else {
      notices.push_back("link '" + link.name + "', visual: " + shape.error().message);
    }
  }
  return link;
}

Expected<Joint> to_joint(const urdf::Joint& from, const tinyxml2::XMLElement& element) {
  Joint joint;
  joint.name = from.name;
  joint.parent = from.parent_link_name;
  joint.child = from.child_link_name;
  joint.T_parent_joint = to_pose(from.parent_to_joint_origin_transform);
  switch (from.type) {
    case urdf::Joint::FIXED:
      return joint;
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      joint.type = JointType::kRevolute;
      break;
    case urdf::Joint::PRISMATIC:
      joint.type = JointType::kPrismatic;
      break;
    case urdf::Joint::PLANAR:
      joint.type = JointType::kPlanar;
      break;
    case urdf::Joint::FLOATING:
      joint.type = JointType::kFloating;
      break;
    default:
      return fail("unknown type of joint");
  }
  const Vec3 axis(from.axis.x, from.axis.y, from.axis.z);
  if (joint.type != JointType::kFloating) {  // that has none
    if (axis.norm() < 1e-9) return fail("the axis has no direction");
    joint.axis = axis.normalized();
  }
  if (auto read = read_motion(element, joint); !read) return fail(read.error().message);
  return joint;
}

}  // namespace

Expected<RobotDescription> parse_urdf(const std::string& xml, const std::string& name,
                                      const MeshSearch& search) {
  tinyxml2::XMLDocument document;
  if (auto parsed = parse_xml(xml, name, "robot", document); !parsed)
    return fail(parsed.error().message);

  Captured captured;
  const auto model = parse_quietly(without_motions(document), captured);
  if (model == nullptr) {
    const auto& messages = captured.messages();
    return fail(place_of(messages, name, document) +
                ": not a URDF robot: " + (messages.empty() ? "reason unknown" : messages.front()));
  }
  RobotDescription robot;
  robot.name = model->getName();
  for (const std::string& message : captured.messages()) {  // it read on, without that
    robot.notices.push_back(place_of({message}, name, document) + ": " + message);
  }
  for (const auto& [link_name, from] : model->links_) {
    auto link = to_link(*from, search, robot.notices);
    if (!link)
      return fail(xml_place(name, find_named(document, "link", link_name)) + ": link '" +
                  link_name + "': " + link.error().message);
    robot.links.push_back(std::move(*link));
  }
  std::string wrong;  // all at once, so that a file is mended in one go
  for (const auto& [joint_name, from] : model->joints_) {
    const auto* element = find_named(document, "joint", joint_name);
    auto joint = to_joint(*from, *element);
    const std::string place = xml_place(name, element);
    if (!joint) {
      wrong += (wrong.empty() ? "" : "; ") + place + ": joint '" + joint_name +
               "': " + joint.error().message;
      continue;
    }
    joint->place = place;
    robot.joints.push_back(std::move(*joint));
  }
  if (!wrong.empty()) return fail(wrong);
  return robot;
}

Expected<RobotDescription> read_urdf(const std::filesystem::path& path,
                                     const std::vector<std::filesystem::path>& package_path) {
  auto xml = read_file(path);
  if (!xml) return fail(xml.error().message);
  return parse_urdf(*xml, path.string(), {path.parent_path(), package_path});
}

}  // namespace canopeer
