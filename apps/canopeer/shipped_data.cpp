#include "shipped_data.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "exit_status.h"

namespace canopeer::app {

namespace fs = std::filesystem;

namespace {

/// What an environment variable says; empty when it is not set.
fs::path path_from_environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

fs::path shipped_data() {
  if (fs::path given = path_from_environment("CANOPEER_DATA"); !given.empty()) return given;
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  const fs::path beside = program.parent_path() / "../share/canopeer";
  if (fs::exists(beside / "missions", code)) return fs::canonical(beside, code);
  return CANOPEER_INSTALLED_DATA;
}

fs::path own_data() {
  if (const fs::path data = path_from_environment("XDG_DATA_HOME"); data.is_absolute()) {
    return data / "canopeer";
  }
  const fs::path home = path_from_environment("HOME");
  return home.empty() ? home : home / ".local/share/canopeer";
}

std::vector<std::string> shipped_missions() {
  std::vector<std::string> names;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(shipped_data() / "missions", code)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path mission_file_of(const std::string& given) {
  std::error_code code;
  const fs::path path(given);
  const bool is_file = fs::exists(path, code) && !fs::is_directory(path, code);
  if (is_file || path.has_extension() || path.has_parent_path()) return path;
  const std::vector<std::string> names = shipped_missions();
  if (std::find(names.begin(), names.end(), given) != names.end()) {
    return shipped_data() / "missions" / (given + ".yaml");
  }
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  if (known.empty())
    known = "none in " + (shipped_data() / "missions").string() + " (CANOPEER_DATA)";
  stop_with(kBadInput,
            {given + ": there is no such file, and no mission of that name; there is: " + known});
}

}  // namespace canopeer::app
