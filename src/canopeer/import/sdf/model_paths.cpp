#include "canopeer/import/sdf/model_paths.h"

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

}  // namespace

ModelPaths::ModelPaths(std::vector<fs::path> roots) : roots_(std::move(roots)) {}

std::vector<fs::path> ModelPaths::candidates(const std::string& uri, const fs::path& folder) const {
  if (const auto rest = below_roots(uri)) {
    std::vector<fs::path> paths;
    for (const fs::path& root : roots_) paths.push_back(root / *rest);
    return paths;
  }
  if (uri.starts_with("file://")) {
    const fs::path path = uri.substr(7);
    return {path.is_absolute() ? path : folder / path};
  }
  return {folder / uri};  // an absolute `uri` replaces `folder`
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
    text += (text.empty() ? "searched: " : ", ") + path.lexically_normal().string();
  }
  return text.empty() ? "no --model-path was given" : text;
}

}  // namespace canopeer
