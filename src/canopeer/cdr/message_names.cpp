#include "canopeer/cdr/message_names.h"

#include "canopeer/base/check.h"

namespace canopeer::ros {

std::string dds_type_name(std::string_view ros_type, std::string_view suffix) {
  const std::size_t package = ros_type.find('/');
  const std::size_t kind = ros_type.rfind('/');
  CANOPEER_CHECK(package != std::string_view::npos && package < kind,
                 "a type is PACKAGE/KIND/NAME");
  std::string name(ros_type.substr(0, package));
  name.append("::").append(ros_type.substr(package + 1, kind - package - 1));
  name.append("::dds_::").append(ros_type.substr(kind + 1)).append(suffix);
  return name;
}

std::string ros_type_name(std::string_view dds_type) {
  constexpr std::string_view kMiddle = "::dds_::";
  const std::size_t package = dds_type.find("::");
  const std::size_t middle = dds_type.find(kMiddle);
  if (middle == std::string_view::npos || package >= middle || dds_type.back() != '_') {
    return std::string(dds_type);
  }
  const std::string_view name = dds_type.substr(middle + kMiddle.size());
  std::string ros(dds_type.substr(0, package));
  ros.append("/").append(dds_type.substr(package + 2, middle - package - 2));
  return ros.append("/").append(name.substr(0, name.size() - 1));
}

}  // namespace canopeer::ros
