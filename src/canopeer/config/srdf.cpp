#include "canopeer/config/srdf.h"

#include <tinyxml2.h>

#include <algorithm>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/xml_lines.h"

namespace canopeer {

Expected<void> parse_srdf(const std::string& xml, const std::string& name,
                          RobotDescription& robot) {
  tinyxml2::XMLDocument document;
  if (auto parsed = parse_xml(xml, name, "robot", document); !parsed) return parsed;
  for (auto* element = document.RootElement()->FirstChildElement("disable_collisions");
       element != nullptr; element = element->NextSiblingElement("disable_collisions")) {
    std::pair<std::string, std::string> pair;
    for (const bool first : {true, false}) {
      const char* const attribute = first ? "link1" : "link2";
      const char* const link = element->Attribute(attribute);
      if (link == nullptr)
        return fail(xml_place(name, element) + ": <disable_collisions> needs " + attribute);
      const bool known = std::any_of(robot.links.begin(), robot.links.end(),
                                     [&](const Link& l) { return l.name == link; });
      if (!known)
        return fail(xml_place(name, element) + ": " + attribute + ": the robot has no link '" +
                    link + "'");
      (first ? pair.first : pair.second) = link;
    }
    robot.disabled_pairs.push_back(std::move(pair));
  }
  return {};
}

Expected<void> read_srdf(const std::filesystem::path& path, RobotDescription& robot) {
  auto xml = read_file(path);
  if (!xml) return fail(xml.error().message);
  return parse_srdf(*xml, path.string(), robot);
}

}  // namespace canopeer
