#include "canopeer/sensing/cloud_file.h"

#include <string>

#include "canopeer/base/atomic_file.h"

namespace canopeer {

Expected<CloudFile> read_cloud(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending != ".ply" && ending != ".pcd" && ending != ".csv") {
    return fail(path.string() + ": expected a point cloud file (.ply, .pcd or .csv)");
  }
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  if (ending == ".csv") return parse_csv_cloud(*bytes, path.string());
  return ending == ".ply" ? parse_ply(*bytes, path.string()) : parse_pcd(*bytes, path.string());
}

}  // namespace canopeer
