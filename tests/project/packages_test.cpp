#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "canopeer/base/text_lines.h"
#include "source_tree.h"

namespace canopeer {
namespace {

using testing_support::IncludeLine;
using testing_support::includes_under;
using testing_support::lines_of;
using testing_support::source_root;

struct HeaderOrigin {
  std::string_view prefix;   ///< of what stands between the brackets
  std::string_view package;  ///< of Debian; empty: the C library or the compiler
};

/// Where the headers we use come from.
constexpr HeaderOrigin kOrigins[] = {
    {"Eigen/", "libeigen3-dev"},
    {"octomap/", "liboctomap-dev"},
    {"embree3/", "libembree-dev"},
    {"embree4/", "libembree-dev"},
    {"fcl/", "libfcl-dev"},
    {"ompl/", "libompl-dev"},
    {"kdl/", "liborocos-kdl-dev"},
    {"urdf_model/", "liburdfdom-headers-dev"},
    {"urdf_parser/", "liburdfdom-dev"},
    {"console_bridge/", "libconsole-bridge-dev"},
    {"cereal/", "libcereal-dev"},
    {"ceres/", "libceres-dev"},
    {"coin/Clp", "coinor-libclp-dev"},
    {"Cbc", "coinor-libcbc-dev"},
    {"Cgl", "coinor-libcgl-dev"},
    {"OsiClp", "coinor-libclp-dev"},
    {"opencv2/core", "libopencv-core-dev"},
    {"opencv2/dnn", "libopencv-dnn-dev"},
    {"opencv2/imgproc", "libopencv-imgproc-dev"},
    {"nanoflann.hpp", "libnanoflann-dev"},
    {"tbb/", "libtbb-dev"},
    {"oneapi/", "libtbb-dev"},
    {"fmt/", "libfmt-dev"},
    {"yaml-cpp/", "libyaml-cpp-dev"},
    {"CLI/", "libcli11-dev"},
    {"boost/", "libboost-dev"},
    {"nlohmann/", "nlohmann-json3-dev"},
    {"tinyxml2.h", "libtinyxml2-dev"},
    {"png.h", "libpng-dev"},
    {"zstd.h", "libzstd-dev"},
    {"zlib.h", "zlib1g-dev"},
    {"jerror.h", "libjpeg-dev"},
    {"jpeglib.h", "libjpeg-dev"},
    {"assimp/", "libassimp-dev"},
    {"sdf/", "libsdformat-dev"},
    {"ignition/math", "libignition-math-dev"},
    {"libqhull_r/", "libqhull-dev"},
    {"stb/", "libstb-dev"},
    {"webp/", "libwebp-dev"},
    {"tl/", "libexpected-dev"},
    {"fastdds/", "libfastdds-dev"},
    {"fastrtps/", "libfastrtps-dev"},
    {"dds/", "cyclonedds-dev"},
    {"gtest/", "libgtest-dev"},
    {"benchmark/", "libbenchmark-dev"},
    {"sys/", ""},
    {"spawn.h", ""},
    {"unistd.h", ""},
    {"immintrin.h", ""},
    {"arm_neon.h", ""},
    {"fcntl.h", ""},
    {"poll.h", ""},
    {"sched.h", ""},
    {"ifaddrs.h", ""},
    {"arpa/", ""},
    {"net/", ""},
    {"dlfcn.h", ""},
};

/// The standard library's headers have neither a folder nor an ending.
bool is_standard(const std::string& header) {
  return header.find_first_of("/.") == std::string::npos;
}

std::optional<std::string_view> package_of(const std::string& header) {
  for (const HeaderOrigin& origin : kOrigins) {
    if (header.rfind(origin.prefix, 0) == 0) return origin.package;
  }
  return std::nullopt;
}

/// A line of packages.txt: `a`, `a|b` (the first that the release has), `a?` (if it has it), `a!c?`
/// (if there is no command c either).
struct Listed {
  std::vector<std::string> names;
  bool optional = false;
};

/// Without the comment that `#` begins, and without blanks.
std::string entry_in(const std::string& line) {
  std::string entry = line.substr(0, line.find('#'));
  std::erase_if(entry, [](char c) { return c == ' ' || c == '\t'; });
  return entry;
}

std::vector<Listed> packages_file() {
  std::vector<Listed> all;
  for (const std::string& line : lines_of(source_root() / "packages.txt")) {
    std::string entry = entry_in(line);
    if (entry.empty()) continue;
    Listed listed;
    listed.optional = entry.back() == '?';
    if (listed.optional) entry.pop_back();
    entry = entry.substr(0, entry.find('!'));
    for (const std::string_view name : words_of(entry, "|")) listed.names.emplace_back(name);
    all.push_back(std::move(listed));
  }
  return all;
}

std::set<std::string> listed_packages(bool optional_too = true) {
  std::set<std::string> packages;
  for (const Listed& listed : packages_file()) {
    if (listed.optional && !optional_too) continue;
    packages.insert(listed.names.begin(), listed.names.end());
  }
  return packages;
}

std::vector<IncludeLine> third_party_includes() {
  std::vector<IncludeLine> all;
  for (const char* dir : {"src", "apps", "tests", "bench"}) {
    for (IncludeLine& include : includes_under(dir)) {
      if (!include.quoted && !is_standard(include.header)) all.push_back(std::move(include));
    }
  }
  return all;
}

TEST(Packages, EveryThirdPartyHeaderComesFromAListedPackage) {
  const std::set<std::string> listed = listed_packages();
  for (const IncludeLine& include : third_party_includes()) {
    const auto package = package_of(include.header);
    ASSERT_TRUE(package.has_value()) << include.where() << ": where does <" << include.header
                                     << "> come from? Say so in kOrigins";
    if (package->empty()) continue;
    EXPECT_EQ(listed.count(std::string(*package)), 1U)
        << include.where() << ": " << *package << " is missing in packages.txt";
  }
}

TEST(Packages, OnlyTestsUseWhatAReleaseMayLack) {
  const std::set<std::string> required = listed_packages(false);
  for (const IncludeLine& include : third_party_includes()) {
    const std::string package(package_of(include.header).value_or(""));
    if (package.empty() || include.where().find("tests/") != std::string::npos) continue;
    EXPECT_EQ(required.count(package), 1U) << include.where() << ": " << package << " is optional";
  }
}

TEST(Packages, EveryListedLibraryIsUsed) {
  std::set<std::string> used;
  for (const IncludeLine& include : third_party_includes()) {
    used.insert(std::string(package_of(include.header).value_or("")));
  }
  for (const Listed& listed : packages_file()) {
    const std::string& first = listed.names.front();
    if (!first.ends_with("-dev")) continue;
    const bool any = std::any_of(listed.names.begin(), listed.names.end(),
                                 [&](const std::string& name) { return used.count(name) != 0; });
    EXPECT_TRUE(any) << first << " is listed but nothing uses it";
  }
}

TEST(Packages, ToolsTheBuildNeedsAreListed) {
  const std::set<std::string> listed = listed_packages();
  for (const char* tool : {"g++", "cmake", "ninja-build"})
    EXPECT_EQ(listed.count(tool), 1U) << tool;
}

}  // namespace
}  // namespace canopeer
