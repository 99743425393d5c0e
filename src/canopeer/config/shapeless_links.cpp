#include "canopeer/config/shapeless_links.h"

#include <map>

namespace canopeer {
namespace {

constexpr std::size_t kLinksShown = 8;

/// The links that hang on the first arm joint.
std::vector<const Link*> moving_links(const RobotDescription& robot,
                                      const std::vector<std::string>& arm_joints) {
  std::map<std::string, const Link*> links;
  for (const Link& link : robot.links) links[link.name] = &link;
  std::multimap<std::string, std::string> children;
  std::vector<std::string> open;
  for (const Joint& joint : robot.joints) {
    children.emplace(joint.parent, joint.child);
    if (!arm_joints.empty() && joint.name == arm_joints.front()) open.push_back(joint.child);
  }
  std::vector<const Link*> moving;
  for (std::size_t i = 0; i < open.size() && i < robot.links.size(); ++i) {
    if (links.count(open[i]) > 0) moving.push_back(links[open[i]]);
    const auto [begin, end] = children.equal_range(std::string(open[i]));
    for (auto it = begin; it != end; ++it) open.push_back(it->second);
  }
  return moving;
}

}  // namespace

std::string links_without_shapes(const RobotDescription& robot,
                                 const std::vector<std::string>& arm_joints) {
  bool any_checked = false;
  std::vector<std::string> seen_only;
  for (const Link* link : moving_links(robot, arm_joints)) {
    any_checked |= !link->collision.empty();
    if (link->collision.empty() && !link->visual.empty()) seen_only.push_back(link->name);
  }
  const std::string remedy =
      "; 'collision: visual' in the robot file takes the visual shapes for it";
  if (!any_checked) {
    return "no link that moves with the arm has a collision shape: nothing is checked, every "
           "motion "
           "counts as free" +
           (seen_only.empty() ? "; give the links <collision> shapes" : remedy);
  }
  if (seen_only.empty()) return {};
  std::string names;
  for (std::size_t i = 0; i < seen_only.size() && i < kLinksShown; ++i)
    names += (i == 0 ? "" : ", ") + seen_only[i];
  if (seen_only.size() > kLinksShown)
    names += " and " + std::to_string(seen_only.size() - kLinksShown) + " more";
  return "no collision shape, so never checked for contact: " + names + remedy;
}

}  // namespace canopeer
