#include "canopeer/config/package_search.h"

#include <tinyxml2.h>

#include <algorithm>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/yaml_document.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// Packages lie no deeper in the folders given: WORKSPACE/src/REPOSITORY/GROUP/PACKAGE.
constexpr int kDeepest = 5;

bool is_folder(const fs::path& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

fs::path normal(const fs::path& folder) {
  std::error_code code;
  const fs::path path = fs::absolute(folder.empty() ? fs::path(".") : folder, code);
  const fs::path tidy = path.lexically_normal();
  return tidy.has_filename() ? tidy : tidy.parent_path();
}

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code code;
  for (fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, code), end;
       !code && it != end; it.increment(code)) {
    if (it->path().filename().string().front() != '.' && is_folder(it->path()))
      found.push_back(it->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

PackageSearch::PackageSearch(const fs::path& directory, const std::vector<fs::path>& given) {
  for (const fs::path& folder : given) starts_.push_back(normal(folder));
  given_ = starts_.size();
  for (fs::path above = normal(directory); above.has_relative_path(); above = above.parent_path())
    starts_.push_back(above);
}

std::vector<fs::path> PackageSearch::above() const {
  return {starts_.begin() + static_cast<std::ptrdiff_t>(given_), starts_.end()};
}

/// The <name> in the folder's package.xml; empty: none.
std::string PackageSearch::name_in(const fs::path& folder) {
  const auto known = names_.find(folder);
  if (known != names_.end()) return known->second;
  std::string name;
  std::error_code code;
  const fs::path file = folder / "package.xml";
  tinyxml2::XMLDocument document;
  if (fs::is_regular_file(file, code)) {
    const auto text = read_file(file);
    if (text && document.Parse(text->data(), text->size()) == tinyxml2::XML_SUCCESS) {
      const auto* package = document.FirstChildElement("package");
      const auto* element = package == nullptr ? nullptr : package->FirstChildElement("name");
      if (element != nullptr && element->GetText() != nullptr) name = element->GetText();
    }
  }
  const auto not_blank = [](char c) { return c != ' ' && c != '\n' && c != '\t' && c != '\r'; };
  name.erase(name.begin(), std::find_if(name.begin(), name.end(), not_blank));
  name.erase(std::find_if(name.rbegin(), name.rend(), not_blank).base(), name.end());
  return names_[folder] = name;
}

void PackageSearch::collect_below(const fs::path& folder, int depth) {
  for (const fs::path& child : folders_in(folder)) {
    if (--folders_left_ < 0) return;
    const std::string name = name_in(child);
    by_name_[name.empty() ? child.filename().string() : name].push_back(child);
    if (name.empty() && depth > 1) collect_below(child, depth - 1);  // no package in a package
  }
}

void PackageSearch::collect() {
  if (collected_) return;
  collected_ = true;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    if (const std::string name = name_in(starts_[i]); !name.empty())
      by_name_[name].push_back(starts_[i]);
    // Of a prefix like /opt/ros/humble only share/ holds packages.
    const fs::path share = starts_[i] / "share";
    const bool prefix = i < given_ && is_folder(share);
    collect_below(prefix ? share : starts_[i], i < given_ && !prefix ? kDeepest : 1);
  }
}

std::vector<fs::path> PackageSearch::folders_of(const std::string& name, bool thorough) {
  std::vector<fs::path> found;
  const auto add = [&](const fs::path& folder) {
    if (std::find(found.begin(), found.end(), folder) == found.end()) found.push_back(folder);
  };
  for (const fs::path& start : starts_) {
    if (start.filename() == name || name_in(start) == name) add(start);
    for (const fs::path& inside : {start / name, start / "share" / name}) {
      if (is_folder(inside)) add(inside);
    }
  }
  if (!thorough) return found;
  collect();
  const auto it = by_name_.find(name);
  if (it != by_name_.end()) {
    for (const fs::path& folder : it->second) add(folder);
  }
  return found;
}

std::string PackageSearch::nearest(const std::string& name) {
  collect();
  std::set<std::string, std::less<>> known;
  for (const auto& [package, folders] : by_name_) {
    // A folder without package.xml is one by its looks only.
    if (std::any_of(folders.begin(), folders.end(),
                    [&](const fs::path& folder) { return !name_in(folder).empty(); }) ||
        package.find(name) != std::string::npos)
      known.insert(package);
  }
  return nearest_name(name, known);
}

}  // namespace canopeer
