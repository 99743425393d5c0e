#pragma once

#include <filesystem>
#include <string>

namespace canopeer::test {

/// Files as people have them, small enough to lie beside the tests.
inline std::filesystem::path input(const std::string& name) {
  return std::filesystem::path(CANOPEER_SOURCE_DIR) / "tests/field/clouds/inputs" / name;
}

}  // namespace canopeer::test
