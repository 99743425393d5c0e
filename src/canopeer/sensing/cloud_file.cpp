#include "canopeer/sensing/cloud_file.h"

#include <string>

#include "canopeer/base/atomic_file.h"

namespace canopeer {

Expected<CloudFile> read_cloud(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending != ".ply" && ending != ".pcd") {
    return fail(path.string() + ": expected a point cloud file (.ply or .pcd)");
  }
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return ending == ".ply" ? parse_ply(*bytes, path.string()) : parse_pcd(*bytes, path.string());
}

}  // namespace canopeer
