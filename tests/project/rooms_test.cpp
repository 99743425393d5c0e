#include <gtest/gtest.h>

#include "architecture_table.h"
#include "source_tree.h"

// The rooms within modules, as "Rooms" in ARCHITECTURE.md has them.

namespace canopeer {
namespace {

using testing_support::Allowed;
using testing_support::closure;
using testing_support::IncludeLine;
using testing_support::includes_under;
using testing_support::names_of;
using testing_support::open_rooms;
using testing_support::Place;
using testing_support::place_of;
using testing_support::room_table;
using testing_support::source_files;
using testing_support::source_root;

/// "canopeer/map/fusion.h" for src/canopeer/map/fusion.h.
std::string address_of(const std::filesystem::path& file) {
  return file.lexically_relative(source_root() / "src").string();
}

/// Address of a file → what it includes of its own module.
using Includes = std::map<std::string, std::set<std::string>>;

Includes includes_within_modules() {
  Includes within;
  for (const IncludeLine& include : includes_under("src/canopeer")) {
    const std::string file = address_of(include.file);
    if (place_of(file).module == place_of(include.header).module) {
      within[file].insert(include.header);
    }
  }
  return within;
}

/// The room that a header is in; of one at the door, those that it shows.
void add_rooms(const Includes& within, const std::string& header, std::set<std::string>& seen,
               std::set<std::string>& rooms) {
  if (!seen.insert(header).second) return;
  const std::string room = place_of(header).room;
  if (!room.empty()) {
    rooms.insert(room);
  } else if (const auto found = within.find(header); found != within.end()) {
    for (const std::string& next : found->second) add_rooms(within, next, seen, rooms);
  }
}

TEST(Rooms, TableNamesExactlyTheFoldersThatExist) {
  std::set<std::string> folders;
  for (const std::filesystem::path& file : source_files("src/canopeer")) {
    const std::string room = place_of(address_of(file)).room;
    if (!room.empty()) folders.insert(room);
  }
  EXPECT_EQ(names_of(room_table()), folders);
}

TEST(Rooms, TableHasNoCyclesAndNoUnknownNames) { testing_support::expect_one_way(room_table()); }

TEST(Rooms, EveryIncludeIsAllowedByTheTable) {
  const Allowed closed = closure(room_table());
  const Includes within = includes_within_modules();
  for (const auto& [file, headers] : within) {
    const auto row = closed.find(place_of(file).room);
    if (row == closed.end()) continue;
    for (const std::string& header : headers) {
      std::set<std::string> seen;
      std::set<std::string> rooms;
      add_rooms(within, header, seen, rooms);
      rooms.erase(row->first);
      for (const std::string& room : rooms) {
        EXPECT_EQ(row->second.count(room), 1U)
            << file << " must not reach " << room << " (by " << header << ')';
      }
    }
  }
}

TEST(Rooms, NobodyOutsideAModuleIncludesWhatIsInside) {
  const std::set<std::string> open = open_rooms();
  for (const char* top : {"src/canopeer", "apps", "examples"}) {
    for (const IncludeLine& include : includes_under(top)) {
      const Place inside = place_of(include.header);
      if (open.count(inside.room) > 0) continue;
      EXPECT_TRUE(inside.room.empty() || inside.module == place_of(address_of(include.file)).module)
          << include.where() << ": " << include.header << " is inside " << inside.module;
    }
  }
}

TEST(Rooms, OnlyTheRegistryKnowsThePlanners) {
  for (const auto& [file, headers] : includes_within_modules()) {
    const Place place = place_of(file);
    if (place.module != "planner" || !place.room.empty()) continue;
    if (file.rfind("canopeer/planner/registry.", 0) == 0) continue;
    for (const std::string& header : headers) {
      EXPECT_TRUE(place_of(header).room.empty()) << file << " must not include " << header;
    }
  }
}

}  // namespace
}  // namespace canopeer
