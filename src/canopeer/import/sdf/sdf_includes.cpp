#include "canopeer/import/sdf/sdf_includes.h"

#include <tinyxml2.h>

#include <algorithm>

#include "canopeer/base/atomic_file.h"
#include "canopeer/import/sdf/fuel_address.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> not_found(const SdfElement& include, const std::string& uri,
                                const std::string& searched) {
  std::string text = include.where() + ": <include><uri>" + uri + ": no such model; ";
  if (!parse_fuel_address(uri)) {
    text += "expected a folder with model.config under a --model-path, or beside the file; ";
  }
  return fail(text + searched);
}

/// What a line of model.config says: which file, and of which version.
struct Choice {
  std::string file;
  SdfVersion version;
};

std::vector<Choice> choices_in(const tinyxml2::XMLElement* model) {
  std::vector<Choice> choices;
  if (model == nullptr) return choices;
  for (auto* sdf = model->FirstChildElement("sdf"); sdf != nullptr;
       sdf = sdf->NextSiblingElement("sdf")) {
    if (sdf->GetText() == nullptr) continue;
    const char* const version = sdf->Attribute("version");
    choices.push_back(
        {sdf->GetText(),
         to_sdf_version(version == nullptr ? "" : version).value_or(SdfVersion{1, 0})});
  }
  return choices;
}

}  // namespace

Expected<fs::path> sdf_in_model_folder(const fs::path& folder) {
  std::error_code code;
  fs::path config = folder / "model.config";
  if (!fs::exists(config, code)) config = folder / "manifest.xml";  // its old name
  if (!fs::exists(config, code) && fs::exists(folder / "model.sdf", code)) {
    return (folder / "model.sdf").lexically_normal();
  }
  if (!fs::exists(config, code)) {
    return fail(folder.string() + ": is no model: it has no model.config");
  }
  const auto text = read_file(config);
  if (!text) return tl::unexpected(text.error());
  tinyxml2::XMLDocument xml;
  if (xml.Parse(text->data(), text->size()) != tinyxml2::XML_SUCCESS) {
    return fail(config.string() + ":" + std::to_string(std::max(xml.ErrorLineNum(), 1)) +
                ": is no sound XML");
  }
  const auto choices = choices_in(xml.FirstChildElement("model"));
  if (choices.empty()) {
    return fail(config.string() + ": expected <model> with <sdf version=…>a file's name</sdf>");
  }
  const Choice* best = nullptr;
  for (const Choice& choice : choices) {
    if (choice.version > kNewestSdf) continue;
    if (best == nullptr || choice.version > best->version) best = &choice;
  }
  return (folder / (best == nullptr ? choices.front() : *best).file).lexically_normal();
}

std::string SdfIncludes::model_name(const std::string& uri) {
  if (const auto address = parse_fuel_address(uri)) return address->folder_name();
  std::string path = uri;
  while (path.ends_with('/')) path.pop_back();
  return path.substr(path.rfind('/') + 1);
}

Expected<const SdfFile*> SdfIncludes::read(const fs::path& path) {
  const auto known = files_.find(path);
  if (known != files_.end()) return known->second.get();
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return fail(path.string() + ": no such file");
  auto file = SdfFile::read(path);
  if (!file) return tl::unexpected(file.error());
  return files_.emplace(path, std::move(*file)).first->second.get();
}

std::optional<fs::path> SdfIncludes::path_of(const SdfElement& include) const {
  return paths_.find(include.child("uri").text(), include.file().path().parent_path());
}

bool SdfIncludes::exists(const SdfElement& include) const { return path_of(include).has_value(); }

Expected<const SdfFile*> SdfIncludes::find(const SdfElement& include) {
  const std::string uri = include.child("uri").text();
  if (uri.empty()) return fail(include.where() + ": <include>: expected a <uri>");
  const std::pair key(include.file().path().parent_path(), uri);
  if (const auto known = found_.find(key); known != found_.end()) return known->second;
  auto file = look_up(include, uri);
  if (file) found_.emplace(key, *file);
  return file;
}

Expected<const SdfFile*> SdfIncludes::look_up(const SdfElement& include, const std::string& uri) {
  const auto path = path_of(include);
  if (!path) {
    return not_found(include, uri, paths_.searched(uri, include.file().path().parent_path()));
  }
  std::error_code code;
  auto file =
      fs::is_directory(*path, code) ? sdf_in_model_folder(*path) : Expected<fs::path>(*path);
  const auto known = file ? read(*file) : tl::unexpected(file.error());
  if (known) return known;
  return fail(known.error().message + " (" + include.where() + ": <include><uri>" + uri +
              " refers to it)");
}

}  // namespace canopeer
