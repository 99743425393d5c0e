#include "canopeer/config/protocols.h"

#include <algorithm>
#include <set>

#include "canopeer/config/yaml_document.h"
#include "canopeer/record/yardstick_shares.h"

namespace canopeer {
namespace {

constexpr std::string_view kTight = "tight";

/// Every protocol sets every rule.
Protocol protocol_of(std::string name, std::string one_line, int time_s, bool whole_clock,
                     int max_views, bool leave_when_done, bool shares_time) {
  const auto yes_no = [](bool on) { return on ? "true" : "false"; };
  return {std::move(name),
          std::move(one_line),
          {{"time_per_segment_s", std::to_string(time_s)},
           {"clock", whole_clock ? "whole" : "paper"},
           {"max_views", std::to_string(max_views)},
           {"leave_when_done", yes_no(leave_when_done)},
           {"shares_time", yes_no(shares_time)}}};
}

std::string names_listed() {
  std::string list;
  for (const Protocol& protocol : protocols()) list += (list.empty() ? "" : ", ") + protocol.name;
  return list;
}

}  // namespace

std::vector<Protocol> protocols() {
  return {
      protocol_of("zaenker2023", "60 s a segment, the paper's clock", 60, false, 0, false, false),
      protocol_of("tight10", "10 s a segment, one clock", 10, true, 0, false, false),
      protocol_of("tight20", "20 s a segment, one clock", 20, true, 0, false, false),
      protocol_of("views10", "10 views a segment, no time limit", 0, false, 10, true, false),
      protocol_of("until_done", "until the planner is done", 0, false, 0, true, false),
      protocol_of("mission", "the time of tight10, shared by the row", 10, true, 0, true, true)};
}

Expected<Protocol> find_protocol(std::string_view name) {
  std::set<std::string, std::less<>> known;
  for (Protocol& protocol : protocols()) {
    if (protocol.name == name) return std::move(protocol);
    known.insert(protocol.name);
  }
  if (name == kTight) return fail("'tight' stands for tight10 and tight20; name one of them");
  const std::string nearest = nearest_name(name, known);
  return fail("unknown protocol '" + std::string(name) + "'" +
              (nearest.empty() ? "" : "; did you mean '" + nearest + "'?") +
              " There are: " + names_listed());
}

Expected<std::vector<std::string>> expand_protocols(const std::vector<std::string>& names) {
  std::vector<std::string> expanded;
  for (const std::string& name : names) {
    if (name == kTight) {
      expanded.insert(expanded.end(), {"tight10", "tight20"});
      continue;
    }
    if (const auto found = find_protocol(name); !found) return tl::unexpected(found.error());
    expanded.push_back(name);
  }
  return expanded;
}

Expected<void> apply_protocol(YamlMap& file,
                              const std::vector<std::pair<std::string, std::string>>& overrides,
                              MissionOptions& mission) {
  const std::string name = file.text("protocol", kOwnProtocol);
  if (name == kOwnProtocol) return {};
  const auto protocol = find_protocol(name);
  if (!protocol) return fail_in(file.where("protocol") + ": protocol", protocol.error());
  for (const auto& [key, value] : protocol->settings) {
    const bool said = std::any_of(overrides.begin(), overrides.end(),
                                  [&key = key](const auto& o) { return o.first == key; });
    if (said) {
      return fail(key + ": protocol '" + name + "' says what it is (" + value +
                  "); leave one of the two out");
    }
    if (auto ok = file.set(key, value); !ok) return ok;
  }
  mission.protocol = name;
  return {};
}

void read_rules(YamlMap& file, MissionOptions& mission) {
  double& time_s = mission.segment_time_s;
  time_s = file.number("time_per_segment_s", time_s, {0.0, 36000.0});
  mission.max_views = file.integer("max_views", mission.max_views, 0, 100000);
  mission.leave_when_done = file.boolean("leave_when_done", mission.leave_when_done);
  mission.shares_time = file.boolean("shares_time", mission.shares_time);
  const bool whole = mission.clock == MissionClock::whole;
  if (time_s > 0.0 && time_s < 1.0) {
    file.complain("time_per_segment_s", "expected 1 or more, or 0 for no limit");
  }
  if (time_s == 0.0 && mission.max_views == 0 && !mission.leave_when_done) {
    file.complain("time_per_segment_s",
                  "0, no limit, expected only with max_views or leave_when_done");
  }
  if (time_s == 0.0 && whole) {
    file.complain(file.has("clock") ? "clock" : "time_per_segment_s",
                  "without a time limit there is no time to share out; expected clock: paper");
  }
  if (mission.shares_time && !whole) {
    file.complain("shares_time", "expected only with clock: whole");
  }
}

}  // namespace canopeer
