#include "canopeer/config/urdf.h"

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <mutex>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/urdf_joints.h"
#include "canopeer/config/urdf_shapes.h"
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

/// The document without what is read elsewhere or not used at all: one odd material, inertia,
/// shape or limit would make urdfdom refuse the whole robot.
std::string skeleton_of(const tinyxml2::XMLDocument& document) {
  tinyxml2::XMLDocument copy;
  document.DeepCopy(&copy);
  const auto strip = [](tinyxml2::XMLElement* from, const char* tag) {
    while (auto* child = from->FirstChildElement(tag)) from->DeleteChild(child);
  };
  auto* const root = copy.RootElement();
  strip(root, "material");
  for (auto* link = root->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    for (const char* tag : {"collision", "visual", "inertial"}) strip(link, tag);
  }
  strip_motions(copy);
  tinyxml2::XMLPrinter printer;
  copy.Print(&printer);
  return printer.CStr();
}

/// In the order of their names.
Expected<void> read_links(const urdf::ModelInterface& model, const tinyxml2::XMLDocument& document,
                          const std::string& name, const UrdfOptions& options,
                          RobotDescription& robot) {
  RobotMeshReader meshes(options.meshes);
  UrdfShapes collision(name, meshes);
  UrdfShapes visual(name, meshes);
  for (const auto& [link_name, from] : model.links_) {
    Link link;
    link.name = link_name;
    const auto* element = find_named(document, "link", link_name);
    if (element != nullptr) {
      link.collision = collision.read(*element, "collision");
      if (options.visual_for_collision && element->FirstChildElement("collision") == nullptr)
        link.collision = collision.read(*element, "visual");
      link.visual = visual.read(*element, "visual");
    }
    robot.links.push_back(std::move(link));
  }
  const std::vector<std::string> wrong = collision.troubles();
  if (!wrong.empty()) {
    std::string all;
    for (const std::string& line : wrong) all += (all.empty() ? "" : "; ") + line;
    return fail(all);
  }
  for (const std::string& line : collision.notices()) robot.notices.push_back(line);
  for (const std::string& line : visual.troubles())
    robot.notices.push_back(line + " (visual: for pictures only)");
  return {};
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
                                      const UrdfOptions& options) {
  tinyxml2::XMLDocument document;
  if (auto parsed = parse_xml(xml, name, "robot", document); !parsed)
    return fail(parsed.error().message);

  Captured captured;
  const auto model = parse_quietly(skeleton_of(document), captured);
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
  if (auto links = read_links(*model, document, name, options, robot); !links)
    return fail(links.error().message);
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
                                     const std::vector<std::filesystem::path>& package_path,
                                     bool visual_for_collision) {
  auto xml = read_file(path);
  if (!xml) return fail(xml.error().message);
  return parse_urdf(*xml, path.string(),
                    {{path.parent_path(), package_path}, visual_for_collision});
}

}  // namespace canopeer
