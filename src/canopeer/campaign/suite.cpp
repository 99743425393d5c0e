#include "canopeer/campaign/suite.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/csv_table.h"
#include "canopeer/base/sha256.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// File, relative to the suite's folder, and its hash.
using HashList = std::map<std::string, std::string>;

/// Lines "hash  file", as sha256sum writes and checks them.
Expected<HashList> parse_hashes(const std::string& text, const std::string& name) {
  HashList hashes;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    constexpr std::size_t kDigits = 64;
    if (line.size() < kDigits + 3 || line.compare(kDigits, 2, "  ") != 0) {
      return fail(name + ":" + std::to_string(number) + ": expected 'HASH  FILE', as of sha256sum");
    }
    hashes[line.substr(kDigits + 2)] = line.substr(0, kDigits);
  }
  return hashes;
}

Expected<SuiteWorld> world_in(const CsvTable& table, std::size_t row) {
  SuiteWorld world;
  for (auto [column, field] : {std::pair{"name", &world.name}, std::pair{"split", &world.split},
                               std::pair{"kind", &world.kind}, std::pair{"noise", &world.noise}}) {
    const auto text = table.text(row, column);
    if (!text) return tl::unexpected(text.error());
    *field = *text;
  }
  const auto levels = table.integer(row, "levels");
  if (!levels) return tl::unexpected(levels.error());
  const auto fruits = table.integer(row, "fruits_counted");
  if (!fruits) return tl::unexpected(fruits.error());
  const auto seed = table.integer(row, "seed");
  if (!seed) return tl::unexpected(seed.error());
  world.levels = *levels;
  world.fruits_counted = *fruits;
  world.seed = static_cast<std::uint64_t>(*seed);
  return world;
}

std::string scene_of(const SuiteWorld& world) {
  return "worlds/" + world.name + "/" + world.name + ".cscene";
}

std::string mission_of(const SuiteWorld& world) {
  return "worlds/" + world.name + "/" + world.name + ".yaml";
}

Expected<HashList> read_hashes(const fs::path& folder) {
  const fs::path path = folder / "SHA256SUMS";
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_hashes(*text, path.string());
}

}  // namespace

const SuiteWorld* Suite::find(std::string_view name) const {
  const auto found =
      std::find_if(worlds.begin(), worlds.end(), [&](const auto& w) { return w.name == name; });
  return found == worlds.end() ? nullptr : &*found;
}

Expected<Suite> load_suite(const fs::path& folder) {
  Suite suite;
  suite.folder = folder;
  const auto version = read_file(folder / "VERSION");
  if (!version) return tl::unexpected(version.error());
  suite.version = version->substr(0, version->find('\n'));
  const auto hashes = read_hashes(folder);
  if (!hashes) return tl::unexpected(hashes.error());
  suite.sha256 = sha256_hex(read_file(folder / "SHA256SUMS").value_or(""));
  const auto table = CsvTable::read(folder / "suite.csv");
  if (!table) return tl::unexpected(table.error());
  for (std::size_t row = 0; row < table->rows(); ++row) {
    auto world = world_in(*table, row);
    if (!world) return tl::unexpected(world.error());
    world->mission = folder / mission_of(*world);
    const auto hash = hashes->find(scene_of(*world));
    if (hash != hashes->end()) world->sha256 = hash->second;
    suite.worlds.push_back(std::move(*world));
  }
  return suite;
}

Expected<void> verify_suite(const Suite& suite) {
  const auto hashes = read_hashes(suite.folder);
  if (!hashes) return tl::unexpected(hashes.error());
  for (const SuiteWorld& world : suite.worlds) {
    for (const std::string& file : {scene_of(world), mission_of(world)}) {
      if (hashes->count(file) == 0) {
        return fail((suite.folder / "SHA256SUMS").string() + ": lists no " + file +
                    "; the suite is not whole: get it anew");
      }
    }
  }
  for (const auto& [file, hash] : *hashes) {
    const auto bytes = read_file(suite.folder / file);
    if (!bytes) return tl::unexpected(bytes.error());
    if (sha256_hex(*bytes) != hash) {
      return fail((suite.folder / file).string() +
                  ": is not what the suite was frozen with, so results could not be compared; get "
                  "it anew (try other settings with `canopeer bench`)");
    }
  }
  return {};
}

Expected<std::vector<SuiteWorld>> worlds_of(const Suite& suite, std::string_view split) {
  std::vector<SuiteWorld> worlds;
  for (const SuiteWorld& world : suite.worlds) {
    if (split == "all" || world.split == split) worlds.push_back(world);
  }
  if (!worlds.empty()) return worlds;
  return fail("there is no split '" + std::string(split) +
              "'; there is: train, validation, test, all");
}

}  // namespace canopeer
