#include "shipped_data.h"

#include <algorithm>
#include <system_error>

#include "exit_status.h"

namespace canopeer::app {

namespace fs = std::filesystem;

fs::path shipped_data() { return CANOPEER_DATA_DIR; }

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
  if (fs::exists(path, code) || path.has_extension() || path.has_parent_path()) return path;
  const std::vector<std::string> names = shipped_missions();
  if (std::find(names.begin(), names.end(), given) != names.end()) {
    return shipped_data() / "missions" / (given + ".yaml");
  }
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  stop_with(kBadInput,
            {given + ": there is no such file, and no mission of that name; there is: " + known});
}

}  // namespace canopeer::app
