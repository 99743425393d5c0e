#include "canopeer/config/srdf.h"

#include <tinyxml2.h>

#include <algorithm>
#include <set>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/xml_lines.h"

namespace canopeer {
namespace {

using Pair = std::pair<std::string, std::string>;

constexpr std::size_t kUnknownShown = 8;

/// What the elements of an SRDF say of a robot's links; those it does not have are kept apart.
class Reader {
 public:
  Reader(const std::string& file, const tinyxml2::XMLElement& root, const RobotDescription& robot)
      : file_(file), root_(root) {
    for (const Link& link : robot.links) known_.insert(link.name);
  }

  /// The pairs in all <tag link1="…" link2="…"/> that are of this robot.
  Expected<std::vector<Pair>> pairs(const char* tag) {
    std::vector<Pair> found;
    for (auto* element = root_.FirstChildElement(tag); element != nullptr;
         element = element->NextSiblingElement(tag)) {
      auto first = link_in(*element, "link1");
      auto second = link_in(*element, "link2");
      if (!first) return tl::unexpected(first.error());
      if (!second) return tl::unexpected(second.error());
      if (!first->empty() && !second->empty()) found.emplace_back(*first, *second);
    }
    return found;
  }

  /// The links in all <tag link="…"/> that are of this robot.
  Expected<std::vector<std::string>> links(const char* tag) {
    std::vector<std::string> found;
    for (auto* element = root_.FirstChildElement(tag); element != nullptr;
         element = element->NextSiblingElement(tag)) {
      auto link = link_in(*element, "link");
      if (!link) return tl::unexpected(link.error());
      if (!link->empty()) found.push_back(*link);
    }
    return found;
  }

  /// Links it names that the robot has not, with the line of the first; empty: none.
  [[nodiscard]] std::string unknown_links() const {
    if (unknown_.empty()) return {};
    std::string text = first_unknown_ + ": the robot has no link";
    std::size_t shown = 0;
    for (const std::string& link : unknown_) {
      if (shown++ == kUnknownShown) break;
      text += (shown == 1 ? " '" : ", '") + link + "'";
    }
    if (unknown_.size() > kUnknownShown)
      text += " and " + std::to_string(unknown_.size() - kUnknownShown) + " more";
    return text + "; what is said of them is left out";
  }
  [[nodiscard]] bool mostly_unknown() const { return unknown_.size() > named_.size(); }

 private:
  /// Empty: a link the robot has not.
  Expected<std::string> link_in(const tinyxml2::XMLElement& element, const char* attribute) {
    const char* const link = element.Attribute(attribute);
    if (link == nullptr)
      return fail(xml_place(file_, &element) + ": <" + element.Name() + "> needs " + attribute);
    if (known_.count(link) > 0) {
      named_.insert(link);
      return link;
    }
    if (unknown_.empty()) first_unknown_ = xml_place(file_, &element);
    unknown_.insert(link);
    return std::string();
  }

  const std::string& file_;
  const tinyxml2::XMLElement& root_;
  std::set<std::string, std::less<>> known_;    // links of the robot
  std::set<std::string, std::less<>> named_;    // of these, in the file
  std::set<std::string, std::less<>> unknown_;  // in the file only
  std::string first_unknown_;                   // its place
};

/// As MoveIt reads them: what is disabled by default is so with all links but those enabled; pairs
/// disabled one by one are so in any case.
void disable(const std::vector<Pair>& pairs, const std::vector<std::string>& by_default,
             const std::vector<Pair>& enabled, RobotDescription& robot) {
  robot.disabled_pairs.insert(robot.disabled_pairs.end(), pairs.begin(), pairs.end());
  const std::set<Pair> kept = [&] {
    std::set<Pair> both;
    for (const auto& [a, b] : enabled) both.insert({{a, b}, {b, a}});
    return both;
  }();
  for (const std::string& link : by_default) {
    for (const Link& other : robot.links) {
      if (other.name != link && kept.count({link, other.name}) == 0)
        robot.disabled_pairs.emplace_back(link, other.name);
    }
  }
}

}  // namespace

Expected<void> parse_srdf(const std::string& xml, const std::string& name,
                          RobotDescription& robot) {
  tinyxml2::XMLDocument document;
  if (auto parsed = parse_xml(xml, name, "robot", document); !parsed) return parsed;
  const tinyxml2::XMLElement& root = *document.RootElement();
  Reader reader(name, root, robot);
  const auto disabled = reader.pairs("disable_collisions");
  if (!disabled) return tl::unexpected(disabled.error());
  const auto enabled = reader.pairs("enable_collisions");
  if (!enabled) return tl::unexpected(enabled.error());
  const auto by_default = reader.links("disable_default_collisions");
  if (!by_default) return tl::unexpected(by_default.error());

  const char* const of = root.Attribute("name");
  const bool other_name = of != nullptr && !robot.name.empty() && robot.name != of;
  if (reader.mostly_unknown() || other_name) {
    robot.notices.push_back(
        xml_place(name, &root) + ": " +
        (reader.mostly_unknown() ? "this is the SRDF of another robot: most of its links are not "
                                   "in this one"
                                 : "is this the SRDF of another robot?") +
        (other_name ? " (it is of '" + std::string(of) + "', the URDF of '" + robot.name + "')"
                    : ""));
  }
  if (const std::string unknown = reader.unknown_links(); !unknown.empty())
    robot.notices.push_back(unknown);
  disable(*disabled, *by_default, *enabled, robot);
  robot.neighbours_may_touch =
      robot.disabled_pairs.empty() && (reader.mostly_unknown() || other_name);
  return {};
}

Expected<void> read_srdf(const std::filesystem::path& path, RobotDescription& robot) {
  auto xml = read_file(path);
  if (!xml) return fail(xml.error().message);
  return parse_srdf(*xml, path.string(), robot);
}

}  // namespace canopeer
