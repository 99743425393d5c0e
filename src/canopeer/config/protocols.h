#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/yaml_reader.h"
#include "canopeer/mission/mission_options.h"

namespace canopeer {

/// Rules of a run by name, so that results of different people can be compared: whose clock counts,
/// how long a segment lasts, and what else ends it.
struct Protocol {
  std::string name;
  std::string one_line;
  /// Keys of a mission file and their values. They come before those of the file.
  std::vector<std::pair<std::string, std::string>> settings;
};

/// All there are:
/// - zaenker2023: 60 s a segment by the paper's clock, transitions not counted;
/// - tight10, tight20: 10, 20 s a segment by the clock that never stops;
/// - views10: ten views a segment, the first at home among them, without a time limit;
/// - until_done: no limit; a segment ends when its planner says so, has nothing to go for, or
///   little comes of it any more (mission/segment/segment_course.h);
/// - mission: the time of tight10 as one budget for the whole row; what a segment leaves of its
///   share goes to those behind it.
[[nodiscard]] std::vector<Protocol> protocols();

/// The error names the nearest, and all there are.
[[nodiscard]] Expected<Protocol> find_protocol(std::string_view name);

/// Names as they are given in a list: "tight" stands for tight10 and tight20. Each must be known.
[[nodiscard]] Expected<std::vector<std::string>> expand_protocols(
    const std::vector<std::string>& names);

/// Reads the key `protocol` (default: own, the mission's own rules) and puts the protocol's
/// settings in place of the file's. The error: it is not known, or one of `overrides` (dotted key
/// and value) contradicts it.
[[nodiscard]] Expected<void> apply_protocol(
    YamlMap& file, const std::vector<std::pair<std::string, std::string>>& overrides,
    MissionOptions& mission);

/// Reads when a segment ends: `time_per_segment_s`, `max_views`, `leave_when_done`, `shares_time`.
/// After read_frames(), which reads `clock`.
void read_rules(YamlMap& file, MissionOptions& mission);

}  // namespace canopeer
