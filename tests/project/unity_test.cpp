#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "source_tree.h"

// Decision 20: the files of a module may be compiled together, however they fall.

namespace canopeer {
namespace {

using testing_support::lines_of;
using testing_support::source_files;
using testing_support::source_root;
namespace fs = std::filesystem;

/// Constants and types of a file's unnamed namespaces, with the lines that make them.
std::map<std::string, std::string> unnamed_names(const fs::path& file) {
  static const std::regex kConstant(R"(^(?:inline )?constexpr .*?\b(k[A-Z]\w*))");
  static const std::regex kType(
      R"(^(?:struct|class|enum class|union|using) (?!namespace|std::|nlohmann::)(?:\w+::)*(\w+))");
  std::map<std::string, std::string> names;
  bool unnamed = false;
  for (const std::string& line : lines_of(file)) {
    if (line == "namespace {") unnamed = true;
    if (line == "}  // namespace") unnamed = false;
    std::smatch found;
    if (unnamed &&
        (std::regex_search(line, found, kConstant) || std::regex_search(line, found, kType))) {
      names[found[1]] = line;
    }
  }
  return names;
}

/// A module's CMakeLists.txt gives the file options of its own: it is compiled alone.
bool is_compiled_alone(const fs::path& file, const fs::path& module) {
  for (const std::string& line : lines_of(module / "CMakeLists.txt")) {
    if (line.find("set_source_files_properties(") != std::string::npos &&
        line.find(file.lexically_relative(module).string()) != std::string::npos) {
      return true;
    }
  }
  return false;
}

TEST(Unity, NamesInUnnamedNamespacesDifferWithinAModule) {
  std::vector<fs::path> modules = {source_root() / "apps/canopeer"};
  for (const auto& entry : fs::directory_iterator(source_root() / "src/canopeer")) {
    modules.push_back(entry.path());
  }
  for (const fs::path& module : modules) {
    std::map<std::string, std::pair<std::string, fs::path>> taken;
    for (const fs::path& file : source_files(module.lexically_relative(source_root()).string())) {
      if (file.extension() != ".cpp" || is_compiled_alone(file, module)) continue;
      for (const auto& [name, line] : unnamed_names(file)) {
        const auto [place, is_new] = taken.try_emplace(name, line, file);
        // The same alias twice is no second meaning.
        if (is_new || (line == place->second.first && line.starts_with("using"))) continue;
        ADD_FAILURE() << name << " is in " << file << " and in " << place->second.second
                      << ": give one of them another name (decision 20)";
      }
    }
  }
}

}  // namespace
}  // namespace canopeer
