#include "canopeer/import/sdf/fuel_address.h"

#include <algorithm>
#include <array>

#include "canopeer/base/percent_encoding.h"
#include "canopeer/base/text_lines.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

std::string in_small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_version(const std::string& text) {
  return !text.empty() && text.size() < 10 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The server by both names it has had, the address's own first.
std::vector<std::string> names_of(const std::string& server) {
  std::vector<std::string> names = {server};
  constexpr std::array kNames = {"fuel.gazebosim.org", "fuel.ignitionrobotics.org"};
  for (const std::string name : kNames) {
    const bool alias =
        server.ends_with("gazebosim.org") || server.ends_with("ignitionrobotics.org");
    if (alias && name != server) names.push_back(name);
  }
  return names;
}

/// Versions that are there, the highest first.
std::vector<std::string> versions_in(const fs::path& folder) {
  std::vector<std::string> versions;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    if (is_version(entry.path().filename().string())) {
      versions.push_back(entry.path().filename().string());
    }
  }
  std::sort(versions.begin(), versions.end(),
            [](const std::string& a, const std::string& b) { return std::stol(a) > std::stol(b); });
  return versions;
}

}  // namespace

std::string FuelAddress::folder_name() const {
  std::string result = in_small_letters(name);
  std::replace(result.begin(), result.end(), ' ', '_');
  return result;
}

std::optional<FuelAddress> parse_fuel_address(const std::string& uri) {
  std::string_view rest = uri;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (uri.starts_with(scheme)) rest.remove_prefix(scheme.size());
  }
  if (rest.size() == uri.size()) return std::nullopt;
  std::vector<std::string> parts;
  for (const std::string_view part : words_of(rest, "/")) parts.push_back(percent_decoded(part));
  if (parts.empty()) return std::nullopt;
  FuelAddress address;
  address.server = parts.front();
  address.name = parts.back();
  const auto models = std::find(parts.begin() + 1, parts.end(), "models");
  if (parts.end() - models < 2 || models - parts.begin() < 2) return address;
  auto owner = models - 1;
  if (*owner == "fuel" && owner - parts.begin() > 1) --owner;
  address.owner = in_small_letters(*owner);
  auto part = models + 1;
  address.name = *part++;
  if (part != parts.end() && (is_version(*part) || *part == "tip")) {
    address.version = *part == "tip" ? "" : *part;
    ++part;
  }
  if (part != parts.end() && *part == "files") {
    for (++part; part != parts.end(); ++part) address.file /= *part;
  }
  return address;
}

std::vector<fs::path> cached_folders(const FuelAddress& address,
                                     const std::vector<fs::path>& caches) {
  std::vector<fs::path> folders;
  if (address.owner.empty()) return folders;
  for (const fs::path& cache : caches) {
    for (const std::string& server : names_of(address.server)) {
      const fs::path model =
          cache / server / address.owner / "models" / in_small_letters(address.name);
      auto versions = versions_in(model);
      if (!address.version.empty()) versions = {address.version};
      for (const std::string& version : versions) folders.push_back(model / version);
      if (versions.empty()) folders.push_back(model);
    }
  }
  return folders;
}

}  // namespace canopeer
