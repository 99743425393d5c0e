#include "canopeer/ros2/out/saved_results.h"

#include <system_error>

#include "canopeer/base/atomic_file.h"
#include "canopeer/fruit/fruits_csv.h"
#include "canopeer/fruit/fruits_json.h"
#include "canopeer/map/map_file.h"

namespace canopeer::ros {

Expected<std::vector<std::filesystem::path>> save_results(
    const std::filesystem::path& folder, const VoxelMap& map,
    const std::vector<FruitEstimate>& fruits) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) return fail(folder.string() + ": cannot make the directory: " + code.message());
  auto written = write_map(map, folder / "map.ot");
  if (!written) return written;
  const std::pair<const char*, std::string> texts[] = {{"fruits.csv", fruits_csv(fruits)},
                                                       {"fruits.json", fruits_json(fruits)}};
  for (const auto& [name, text] : texts) {
    if (auto ok = write_file(folder / name, text); !ok) return tl::unexpected(ok.error());
    written->push_back(folder / name);
  }
  return written;
}

}  // namespace canopeer::ros
