#include "canopeer/sensing/files/timed_files.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "canopeer/base/plain_text.h"
#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/pose_layout.h"

namespace canopeer {
namespace {

// `timestamp file` from two words.
Expected<TimedFile> timed_file(std::string_view time, std::string_view file, int line) {
  const auto seconds = to_number(time);
  if (!seconds || !std::isfinite(*seconds)) {
    return fail("expected a time stamp in seconds, got \"" + std::string(time.substr(0, 40)) +
                "\"");
  }
  return TimedFile{seconds_of_stamp(*seconds), std::string(file), line};
}

// Calls `take(words, line number)` for every line with something on it.
template <typename Take>
Expected<void> for_each_line(std::string_view text, const std::string& name, Take&& take) {
  const PlainText plain(text);
  TextLines lines(plain.view());
  while (const auto line = lines.next()) {
    auto words = words_of(*line);
    if (words.empty() || words[0][0] == '#') continue;
    // EuRoC puts a comma behind the time stamp.
    if (words[0].find(',') != std::string_view::npos) words = words_of(*line, " \t,");
    if (const Expected<void> done = take(words, lines.number()); !done) {
      return fail_in(name + ":" + std::to_string(lines.number()), done.error());
    }
  }
  return {};
}

bool names_depth(const std::string& file) { return file.rfind("depth", 0) == 0; }

}  // namespace

Expected<std::vector<TimedFile>> parse_timed_files(std::string_view text, const std::string& name) {
  std::vector<TimedFile> files;
  const auto done = for_each_line(text, name, [&](const auto& words, int line) -> Expected<void> {
    if (words.size() != 2) {
      return fail("expected `timestamp file`, got " + std::to_string(words.size()) + " words");
    }
    auto file = timed_file(words[0], words[1], line);
    if (!file) return tl::unexpected(file.error());
    files.push_back(*std::move(file));
    return {};
  });
  if (!done) return tl::unexpected(done.error());
  std::stable_sort(files.begin(), files.end(),
                   [](const TimedFile& a, const TimedFile& b) { return a.time_s < b.time_s; });
  return files;
}

Expected<std::vector<AssociatedFiles>> parse_associations(std::string_view text,
                                                          const std::string& name) {
  std::vector<AssociatedFiles> all;
  const auto done = for_each_line(text, name, [&](const auto& words, int line) -> Expected<void> {
    if (words.size() != 4) {
      return fail("expected `timestamp file timestamp file`, got " + std::to_string(words.size()) +
                  " words");
    }
    auto first = timed_file(words[0], words[1], line);
    auto second = timed_file(words[2], words[3], line);
    if (!first) return tl::unexpected(first.error());
    if (!second) return tl::unexpected(second.error());
    if (names_depth(first->file)) std::swap(*first, *second);
    all.push_back({*std::move(second), *std::move(first)});
    return {};
  });
  if (!done) return tl::unexpected(done.error());
  std::stable_sort(all.begin(), all.end(), [](const AssociatedFiles& a, const AssociatedFiles& b) {
    return a.depth.time_s < b.depth.time_s;
  });
  return all;
}

std::filesystem::path trajectory_in(const std::filesystem::path& directory,
                                    std::vector<std::string> names) {
  for (const char* ending : {".txt", ".csv"}) {
    for (const char* stem : {"poses", "pose", "trajectory", "groundtruth"}) {
      names.push_back(std::string(stem) + ending);
    }
  }
  names.emplace_back("trajectory.log");
  for (const std::string& name : names) {
    std::error_code code;
    if (std::filesystem::exists(directory / name, code)) return directory / name;
  }
  return {};
}

std::size_t nearest_in_time(const std::vector<TimedFile>& files, double time_s,
                            double max_difference_s) {
  const auto after =
      std::lower_bound(files.begin(), files.end(), time_s,
                       [](const TimedFile& file, double time) { return file.time_s < time; });
  std::size_t best = files.size();
  double best_difference = max_difference_s;
  const auto consider = [&](std::size_t i) {
    const double difference = std::abs(files[i].time_s - time_s);
    if (difference > best_difference) return;
    best = i;
    best_difference = difference;
  };
  const auto i = static_cast<std::size_t>(after - files.begin());
  if (i < files.size()) consider(i);
  if (i > 0) consider(i - 1);
  return best;
}

}  // namespace canopeer
