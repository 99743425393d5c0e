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

}  // namespace canopeer::ros
