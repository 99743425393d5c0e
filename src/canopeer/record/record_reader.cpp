#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "canopeer/base/atomic_file.h"
#include "canopeer/record/event_json.h"
#include "canopeer/record/record_file.h"

namespace canopeer {
namespace {

using event_json::Json;

/// Builds the run up event by event; the readers of event_json throw on a malformed one.
class RecordReader {
 public:
  void header(const Json& line) {
    record_.header = event_json::to_header(line);
    record_.interrupted = true;  // until the last line says otherwise
  }

  void event(const Json& line) {
    const auto begin = line.begin();
    if (begin == line.end()) return;
    const std::string& kind = begin.key();
    const Json& body = begin.value();
    if (kind == "segment_begin") begin_segment(body);
    if (kind == "segment_end") end_segment(body);
    if (kind == "view") add(event_json::to_view(body));
    if (kind == "frame") add(event_json::to_frame(body, fruits_));
    if (kind == "motion") add(event_json::to_motion(body));
    if (kind == "steering") record_.steering.push_back(event_json::to_steering(body));
    if (kind == "fault") record_.faults.push_back(event_json::to_fault(body));
    if (kind == "work") record_.work = event_json::to_work(body);
    if (kind == "time") record_.time = event_json::to_time(body);
    if (kind == "end") end(body);
  }

  RunRecord take() {
    if (record_.interrupted) record_.end_s = std::max(record_.end_s, last_s_);
    for (SegmentEvent& segment : record_.segments) {
      if (open(segment)) segment.end_s = record_.end_s;
    }
    return std::move(record_);
  }

 private:
  static constexpr double kOpen = -1.0;
  static bool open(const SegmentEvent& segment) { return segment.end_s == kOpen; }

  void begin_segment(const Json& body) {
    SegmentEvent segment = event_json::to_segment(body);
    segment.end_s = kOpen;
    last_s_ = std::max(last_s_, segment.start_s);
    record_.segments.push_back(std::move(segment));
  }

  void end_segment(const Json& body) {
    const int number = body.at("segment").get<int>();
    const double end_s = event_json::to_number(body.at("end_s"));
    last_s_ = std::max(last_s_, end_s);
    for (SegmentEvent& segment : record_.segments) {
      if (segment.segment == number && open(segment)) segment.end_s = end_s;
    }
  }

  void add(ViewEvent view) {
    last_s_ = std::max(last_s_, view.t_s);
    fruits_ = view.fruits;
    record_.views.push_back(std::move(view));
  }

  void add(FrameEvent frame) {
    last_s_ = std::max(last_s_, frame.t_s);
    frame.view = static_cast<int>(record_.views.size());
    fruits_ = frame.fruits;
    record_.frames.push_back(std::move(frame));
  }

  void add(MotionEvent motion) {
    last_s_ = std::max(last_s_, motion.start_s + motion.duration_s);
    record_.motions.push_back(std::move(motion));
  }

  void end(const Json& body) {
    record_.end_s = event_json::to_number(body.at("end_s"));
    record_.interrupted = body.at("interrupted").get<bool>();
  }

  RunRecord record_;
  double last_s_ = 0.0;
  std::vector<FruitSnapshot> fruits_;  // of the last frame
};

Expected<void> check_version(const Json& line) {
  const auto version = line.find("canopeer_record");
  if (version == line.end()) {
    return fail("this is no run record, expected {\"canopeer_record\":1,…} in the first line");
  }
  if (*version != event_json::kFormatVersion) {
    return fail("record format " + version->dump() + ", this program reads format " +
                std::to_string(event_json::kFormatVersion));
  }
  return {};
}

/// One line into the reader; the error has no file and line yet.
Expected<void> read_line(std::string_view text, bool first, RecordReader& reader) {
  const Json line = Json::parse(text, nullptr, false);
  if (!line.is_object()) {
    return fail(first
                    ? "this is no run record, expected {\"canopeer_record\":1,…} in the first line"
                    : "expected one JSON object");
  }
  try {
    if (!first) {
      reader.event(line);
      return {};
    }
    if (auto version = check_version(line); !version) return version;
    reader.header(line);
    return {};
  } catch (const Json::exception& exception) {
    return fail(event_json::reason(exception));
  }
}

}  // namespace

namespace {

std::filesystem::path file_of(const std::filesystem::path& path) {
  std::error_code code;
  return std::filesystem::is_directory(path, code) ? path / "record" : path;
}

/// `file` is for messages.
Expected<RunRecord> parse_record(const std::string& file, std::string_view rest) {
  RecordReader reader;
  int number = 1;
  for (; !rest.empty(); ++number) {
    const std::size_t end = rest.find('\n');
    const bool whole = end != std::string_view::npos;
    const Expected<void> read = read_line(rest.substr(0, end), number == 1, reader);
    // Half a line at the end is where a killed run stopped writing.
    if (!read && (whole || number == 1)) {
      return fail_in(file + ":" + std::to_string(number), read.error());
    }
    rest.remove_prefix(whole ? end + 1 : rest.size());
  }
  if (number == 1) return fail(file + ": empty, expected a run record");
  return reader.take();
}

}  // namespace

Expected<RunRecord> read_record(const std::filesystem::path& path) {
  const std::filesystem::path file = file_of(path);
  const Expected<std::string> content = read_file(file);
  if (!content) return tl::unexpected(content.error());
  return parse_record(file.string(), *content);
}

Expected<RunRecord> read_record_until(const std::filesystem::path& path, std::uint64_t bytes) {
  const std::filesystem::path file = file_of(path);
  const Expected<std::string> content = read_file(file);
  if (!content) return tl::unexpected(content.error());
  if (content->size() < bytes) {
    return fail(file.string() + ": has " + std::to_string(content->size()) +
                " bytes; the run that is to go on had written " + std::to_string(bytes));
  }
  if (bytes == 0 || (*content)[bytes - 1] != '\n') {
    return fail(file.string() + ": is of another run: no line ends at byte " +
                std::to_string(bytes));
  }
  return parse_record(file.string(), std::string_view(*content).substr(0, bytes));
}

}  // namespace canopeer
