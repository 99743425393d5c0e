#include "canopeer/import/sdf/model_paths.h"

#include <algorithm>

#include "canopeer/base/percent_encoding.h"
#include "canopeer/import/sdf/fuel_address.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// What comes after one of the schemes that mean "somewhere under the model path".
std::optional<std::string> below_roots(const std::string& uri) {
  for (const char* scheme : {"model://", "package://"}) {
    if (uri.starts_with(scheme)) return uri.substr(std::string(scheme).size());
  }
  return std::nullopt;
}

/// As it is written, and what its %20 and the like stand for.
std::vector<std::string> spellings(const std::string& path) {
  std::vector<std::string> all = {path};
  if (std::string plain = percent_decoded(path); plain != path) all.push_back(std::move(plain));
  return all;
}

}  // namespace

ModelPaths::ModelPaths(std::vector<fs::path> roots, std::vector<fs::path> fuel_caches)
    : roots_(std::move(roots)), fuel_caches_(std::move(fuel_caches)) {}

std::vector<fs::path> ModelPaths::candidates(const std::string& uri, const fs::path& folder) const {
  std::vector<fs::path> paths;
  if (const auto address = parse_fuel_address(uri)) {
    for (const fs::path& root : roots_) {
      paths.push_back(root / address->folder_name() / address->file);
      if (address->name != address->folder_name()) {
        paths.push_back(root / address->name / address->file);
      }
    }
    for (const fs::path& model : cached_folders(*address, fuel_caches_)) {
      paths.push_back(model / address->file);
    }
    return paths;
  }
  if (const auto rest = below_roots(uri)) {
    for (const std::string& path : spellings(*rest)) {
      for (const fs::path& root : roots_) paths.push_back(root / path);
    }
    return paths;
  }
  // An absolute path replaces `folder`.
  const std::string given = uri.starts_with("file://") ? uri.substr(7) : uri;
  for (const std::string& path : spellings(given)) paths.push_back(folder / path);
  return paths;
}

std::optional<fs::path> ModelPaths::find(const std::string& uri, const fs::path& folder) const {
  for (const fs::path& path : candidates(uri, folder)) {
    std::error_code code;
    if (!uri.empty() && fs::exists(path, code)) return path.lexically_normal();
  }
  return std::nullopt;
}

std::string ModelPaths::searched(const std::string& uri, const fs::path& folder) const {
  std::string text;
  for (const fs::path& path : candidates(uri, folder)) {
    std::string shown = path.lexically_normal().string();
    while (shown.size() > 1 && shown.ends_with('/')) shown.pop_back();
    text += (text.empty() ? "searched: " : ", ") + shown;
  }
  if (text.empty()) text = "no --model-path was given";
  const auto address = parse_fuel_address(uri);
  if (!address) return text;
  return "the network is not read; fetch the model with 'gz fuel download -u \"" + uri +
         "\"', or put its folder, '" + address->folder_name() + "', under a --model-path; " + text;
}

}  // namespace canopeer
