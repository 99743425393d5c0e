#include "canopeer/ros2/out/robot_description_text.h"

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/robot_file.h"

namespace canopeer::ros {

std::string with_whole_file_names(std::string_view urdf, const std::filesystem::path& folder) {
  constexpr std::string_view kAttribute = "filename=";
  std::string text;
  while (true) {
    const std::size_t attribute = urdf.find(kAttribute);
    const std::size_t quote = attribute + kAttribute.size();
    if (attribute == std::string_view::npos || quote >= urdf.size()) break;
    const std::size_t end = urdf.find(urdf[quote], quote + 1);
    if (end == std::string_view::npos) break;
    const std::string_view name = urdf.substr(quote + 1, end - quote - 1);
    text += urdf.substr(0, quote + 1);
    const bool whole = name.find("://") != std::string_view::npos || name.starts_with('/');
    if (!whole) text += "file://" + (folder / "").string();
    text += name;
    urdf.remove_prefix(end);
  }
  return text.append(urdf);
}

Expected<std::string> robot_description_text(const std::filesystem::path& robot_file) {
  const auto urdf = robot_urdf(robot_file);
  if (!urdf) return tl::unexpected(urdf.error());
  const auto text = read_file(*urdf);
  if (!text) return tl::unexpected(text.error());
  return with_whole_file_names(*text, std::filesystem::absolute(*urdf).parent_path());
}

}  // namespace canopeer::ros
