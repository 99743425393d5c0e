#pragma once

#include <map>
#include <set>
#include <string>

namespace canopeer::testing_support {

/// Name → names it may include.
using Allowed = std::map<std::string, std::set<std::string>>;

/// The table under "Modules" of ARCHITECTURE.md: "map" → {"sensing"}.
[[nodiscard]] Allowed module_table();

/// The table under "Rooms": "map/fusion" → {"map/storage"}.
[[nodiscard]] Allowed room_table();

/// The rooms marked "(open)" there: those that everybody may include.
[[nodiscard]] std::set<std::string> open_rooms();

/// The table with "may include" followed through.
[[nodiscard]] Allowed closure(const Allowed& allowed);

/// Expects no cycles, and that every name has a row.
void expect_one_way(const Allowed& allowed);

[[nodiscard]] std::set<std::string> names_of(const Allowed& allowed);

/// Where a header is: module "map" and room "map/storage" of "canopeer/map/storage/block.h". The
/// room is empty at a module's door; both are for headers that are not ours.
struct Place {
  std::string module;
  std::string room;
};
[[nodiscard]] Place place_of(const std::string& header);

}  // namespace canopeer::testing_support
