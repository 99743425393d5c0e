#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer {

/// A file that was recorded at a time.
struct TimedFile {
  double time_s = 0.0;
  std::string file;  ///< as the list spells it
  int line = 0;      ///< of the list
};

/// Depth and colour image of one observation.
struct AssociatedFiles {
  TimedFile depth;
  TimedFile color;
};

/// Lines `timestamp file` or `timestamp,file` (# begins a comment), sorted by time. `name` stands
/// for the list in errors.
[[nodiscard]] Expected<std::vector<TimedFile>> parse_timed_files(std::string_view text,
                                                                 const std::string& name);

/// Lines `timestamp file timestamp file`, sorted by the time of the depth image. Which of the two
/// is depth is told by a path that begins with "depth"; without one, colour comes first.
[[nodiscard]] Expected<std::vector<AssociatedFiles>> parse_associations(std::string_view text,
                                                                        const std::string& name);

/// The trajectory of a recording's folder: the first of `names` that is there, else poses.txt,
/// pose.txt, trajectory.txt, groundtruth.txt, the same as .csv, or trajectory.log; else empty.
[[nodiscard]] std::filesystem::path trajectory_in(const std::filesystem::path& directory,
                                                  std::vector<std::string> names = {});

/// The index of the file nearest in time, or files.size(): none within `max_difference_s`.
[[nodiscard]] std::size_t nearest_in_time(const std::vector<TimedFile>& files, double time_s,
                                          double max_difference_s);

}  // namespace canopeer
