#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace canopeer {

/// Where the poses of a recording come from.
struct PoseSource {
  std::filesystem::path file;
  std::string taken;           ///< which columns were taken for what
  bool order_is_said = false;  ///< the order of quaternions is not only assumed
  std::vector<std::string> notices;
};

}  // namespace canopeer
