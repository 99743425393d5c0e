#include "source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "canopeer/base/atomic_file.h"

namespace canopeer::testing_support {

std::string IncludeLine::where() const {
  return file.lexically_relative(source_root()).string() + ":" + std::to_string(line);
}

std::filesystem::path source_root() { return CANOPEER_SOURCE_DIR; }

std::vector<std::filesystem::path> source_files(const std::string& dir) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path root = source_root() / dir;
  if (!std::filesystem::exists(root)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".h" || extension == ".cpp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<IncludeLine> includes_under(const std::string& dir) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  std::vector<IncludeLine> includes;
  for (const std::filesystem::path& file : source_files(dir)) {
    int number = 0;
    for (const std::string& line : lines_of(file)) {
      ++number;
      std::smatch match;
      if (std::regex_search(line, match, pattern)) {
        includes.push_back({file, number, match[2].str(), match[1].str() == "\""});
      }
    }
  }
  return includes;
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  const Expected<std::string> content = read_file(path);
  EXPECT_TRUE(content.has_value()) << content.error().message;
  std::vector<std::string> lines;
  std::istringstream in(content.value_or(""));
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace canopeer::testing_support
