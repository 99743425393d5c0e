#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer {

struct YamlDocument;
struct YamlNode;

/// Legal values of a number, both ends included.
struct NumberRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// One mapping of a YAML file, read strictly. Each getter marks its key as known and returns the
/// value, or the default when the key is absent; what is wrong (type, range, missing required key)
/// is noted with file and line, and the getter returns its default so that reading can go on.
/// finish() on any map of the document gives the first complaint, unknown keys included, with the
/// nearest known key. Copies share the document. Not thread-safe.
///
///     YamlMap mission = *YamlMap::load(path);
///     const double time_s = mission.number("time_per_segment_s", 60.0, {1.0, 3600.0});
///     YamlMap camera = mission.map("camera");
///     …
///     if (auto done = mission.finish(); !done) return fail(done.error().message);
class YamlMap {
 public:
  /// The file's top mapping. Errors: unreadable file, malformed YAML (with line), no mapping.
  /// `prefix`: what the keys' dotted names begin with in settings_json().
  [[nodiscard]] static Expected<YamlMap> load(const std::filesystem::path& path,
                                              std::string prefix = {});
  /// The same from text; `name` stands for the file in messages.
  [[nodiscard]] static Expected<YamlMap> parse(std::string_view text, std::string name);

  /// Sets a scalar by its dotted key ("planner.neighbours"), before reading, as `--set` does;
  /// `value` is YAML. Mappings on the way are made when absent.
  [[nodiscard]] Expected<void> set(std::string_view dotted_key, std::string_view value);

  [[nodiscard]] bool has(std::string_view key) const;
  /// It is there, and neither a mapping nor a sequence nor nothing.
  [[nodiscard]] bool is_text(std::string_view key) const;
  [[nodiscard]] bool is_map(std::string_view key) const;

  double number(std::string_view key, double fallback, NumberRange range = {});
  double required_number(std::string_view key, NumberRange range = {});
  int integer(std::string_view key, int fallback, int min = std::numeric_limits<int>::min(),
              int max = std::numeric_limits<int>::max());
  int required_integer(std::string_view key, int min = std::numeric_limits<int>::min(),
                       int max = std::numeric_limits<int>::max());
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::string fallback);
  std::string required_text(std::string_view key);
  /// One of `choices`.
  std::string choice(std::string_view key, std::string fallback,
                     const std::vector<std::string>& choices);

  /// A sequence of numbers; `count` > 0 demands that many. Absent: `fallback`.
  std::vector<double> numbers(std::string_view key, std::vector<double> fallback,
                              std::size_t count = 0, NumberRange range = {});
  /// As numbers(), but the key must be there; zeros when it is wrong or missing.
  std::vector<double> required_numbers(std::string_view key, std::size_t count,
                                       NumberRange range = {});
  std::vector<std::string> texts(std::string_view key, std::vector<std::string> fallback);
  /// The same, where a lone text stands for a sequence of one.
  std::vector<std::string> text_or_texts(std::string_view key, std::vector<std::string> fallback);

  /// The mapping under `key`; an empty one when absent.
  YamlMap map(std::string_view key);
  YamlMap required_map(std::string_view key);
  /// The mappings of a sequence; empty when absent.
  std::vector<YamlMap> maps(std::string_view key);
  /// The keys of this mapping in file order (for mappings whose keys are names).
  [[nodiscard]] std::vector<std::string> keys() const;

  /// Notes a complaint of the caller's about `key`: "file:line: key: message".
  void complain(std::string_view key, const std::string& message);
  /// "file:line" of the key, or of the mapping when the key is absent.
  [[nodiscard]] std::string where(std::string_view key = {}) const;
  /// Directory of the file, to resolve relative paths against.
  [[nodiscard]] std::filesystem::path directory() const;

  /// Every key read so far with the value in force, defaults too, as a flat JSON object by dotted
  /// key: each is what `--set` takes.
  [[nodiscard]] std::string settings_json() const;

  /// The first complaint about the document so far, or an unknown key in any of its mappings.
  [[nodiscard]] Expected<void> finish() const;

 private:
  YamlMap(std::shared_ptr<YamlDocument> document, YamlNode* node, std::string path);
  [[nodiscard]] std::string dotted(std::string_view key) const;
  void note(std::string_view key, const std::string& json);
  YamlNode* take(std::string_view key);
  YamlNode* take_required(std::string_view key);
  void complain_at(const YamlNode& node, std::string_view key, const std::string& message);
  double to_number(const YamlNode& node, std::string_view key, NumberRange range, double fallback);
  std::vector<double> to_numbers(const YamlNode& node, std::string_view key, std::size_t count,
                                 NumberRange range, std::vector<double> fallback);

  std::shared_ptr<YamlDocument> document_;
  YamlNode* node_;
  std::string path_;  // dotted key of this mapping; empty: the whole file
};

}  // namespace canopeer
