#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "canopeer/record/event_json.h"
#include "canopeer/record/record_file.h"

namespace canopeer {

using event_json::Json;

struct RecordWriter::File {
  std::filesystem::path path;
  std::ofstream out;
  std::uint64_t bytes = 0;
  std::vector<FruitSnapshot> fruits;  // of the last frame

  Expected<void> line(const Json& json) {
    // A name that is not UTF-8 must not cost the run its record.
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
    errno = 0;
    out << text;
    out.flush();
    if (!out) {
      return fail(path.string() + ": cannot write: " +
                  (errno != 0 ? std::strerror(errno) : "a write before failed"));
    }
    bytes += text.size();
    return {};
  }
};

RecordWriter::RecordWriter(std::unique_ptr<File> file) : file_(std::move(file)) {}
RecordWriter::RecordWriter(RecordWriter&& other) noexcept = default;
RecordWriter& RecordWriter::operator=(RecordWriter&& other) noexcept = default;
RecordWriter::~RecordWriter() = default;

Expected<RecordWriter> RecordWriter::create(const std::filesystem::path& run_dir,
                                            const RunHeader& header) {
  std::error_code code;
  std::filesystem::create_directories(run_dir, code);
  if (code) return fail(run_dir.string() + ": cannot make the directory: " + code.message());
  auto file = std::make_unique<File>();
  file->path = run_dir / "record";
  file->out.open(file->path, std::ios::binary | std::ios::trunc);
  if (!file->out) return fail(file->path.string() + ": cannot write: " + std::strerror(errno));
  if (auto written = file->line(event_json::from(header)); !written) {
    return fail(written.error().message);
  }
  return RecordWriter(std::move(file));
}

Expected<RecordWriter> RecordWriter::resume(const std::filesystem::path& run_dir,
                                            std::uint64_t bytes,
                                            std::vector<FruitSnapshot> fruits) {
  auto file = std::make_unique<File>();
  file->path = run_dir / "record";
  file->bytes = bytes;
  file->fruits = std::move(fruits);
  std::error_code code;
  const auto there = std::filesystem::file_size(file->path, code);
  if (code) return fail(file->path.string() + ": cannot read: " + code.message());
  if (there < bytes) {
    return fail(file->path.string() + ": has " + std::to_string(there) +
                " bytes, the state to go on from was written after " + std::to_string(bytes));
  }
  std::filesystem::resize_file(file->path, bytes, code);
  if (code) return fail(file->path.string() + ": cannot write: " + code.message());
  file->out.open(file->path, std::ios::binary | std::ios::app);
  if (!file->out) return fail(file->path.string() + ": cannot write: " + std::strerror(errno));
  return RecordWriter(std::move(file));
}

std::uint64_t RecordWriter::bytes() const { return file_->bytes; }

Expected<void> RecordWriter::begin_segment(const SegmentEvent& segment) {
  return file_->line({{"segment_begin", event_json::from(segment)}});
}

Expected<void> RecordWriter::end_segment(int segment, double end_s) {
  return file_->line({{"segment_end", {{"segment", segment}, {"end_s", end_s}}}});
}

Expected<void> RecordWriter::add(const ViewEvent& view) {
  file_->fruits = view.fruits;
  return file_->line({{"view", event_json::from(view)}});
}

Expected<void> RecordWriter::add(const FrameEvent& frame) {
  const std::vector<FruitSnapshot> before = std::exchange(file_->fruits, frame.fruits);
  return file_->line({{"frame", event_json::from(frame, before)}});
}

Expected<void> RecordWriter::add(const MotionEvent& motion) {
  return file_->line({{"motion", event_json::from(motion)}});
}

Expected<void> RecordWriter::add(const SteeringEvent& steering) {
  return file_->line({{"steering", event_json::from(steering)}});
}

Expected<void> RecordWriter::add(const FaultEvent& fault) {
  return file_->line({{"fault", event_json::from(fault)}});
}

Expected<void> RecordWriter::set_work(const std::vector<WorkItem>& work) {
  return file_->line({{"work", event_json::from(work)}});
}

Expected<void> RecordWriter::set_time(const TimeSplit& time) {
  return file_->line({{"time", event_json::from(time)}});
}

Expected<void> RecordWriter::finish(double end_s, bool interrupted) {
  return file_->line({{"end", {{"end_s", end_s}, {"interrupted", interrupted}}}});
}

}  // namespace canopeer
