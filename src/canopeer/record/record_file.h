#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/record/run_record.h"

namespace canopeer {

/// Writes `RUN_DIR/record`: one JSON object per line, the header first, every line flushed when it
/// is written, so that a killed run keeps what it earned. The same events give the same bytes;
/// numbers are written so that they read back exactly (a number that is not finite becomes null,
/// and reads back as NaN). The format is in docs/formats.md. Not thread-safe.
///
/// An error says that the file cannot be written; what was written before stays readable.
class RecordWriter {
 public:
  /// Makes the directory when it is missing and starts the record, replacing an older one.
  [[nodiscard]] static Expected<RecordWriter> create(const std::filesystem::path& run_dir,
                                                     const RunHeader& header);
  /// Goes on with the record that is there, from `bytes` on, the end of a line: what stands behind
  /// them goes. `fruits`: those of the last frame in it. The error says that the record is shorter
  /// than that, or cannot be written.
  [[nodiscard]] static Expected<RecordWriter> resume(const std::filesystem::path& run_dir,
                                                     std::uint64_t bytes,
                                                     std::vector<FruitSnapshot> fruits = {});
  RecordWriter(RecordWriter&& other) noexcept;
  RecordWriter& operator=(RecordWriter&& other) noexcept;
  ~RecordWriter();

  /// `segment.end_s` is not written; it comes with end_segment().
  [[nodiscard]] Expected<void> begin_segment(const SegmentEvent& segment);
  [[nodiscard]] Expected<void> end_segment(int segment, double end_s);
  [[nodiscard]] Expected<void> add(const ViewEvent& view);
  [[nodiscard]] Expected<void> add(const FrameEvent& frame);
  [[nodiscard]] Expected<void> add(const MotionEvent& motion);
  [[nodiscard]] Expected<void> add(const SteeringEvent& steering);
  [[nodiscard]] Expected<void> add(const FaultEvent& fault);
  /// Sums from the start of the run; a later call replaces an earlier one.
  [[nodiscard]] Expected<void> set_work(const std::vector<WorkItem>& work);
  /// Where the time went until now; a later call replaces an earlier one.
  [[nodiscard]] Expected<void> set_time(const TimeSplit& time);
  /// The last line. A record without it reads as interrupted.
  [[nodiscard]] Expected<void> finish(double end_s, bool interrupted);

  /// Written so far.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  struct File;
  explicit RecordWriter(std::unique_ptr<File> file);
  std::unique_ptr<File> file_;
};

/// Reads a record; `path` is the file or its run directory. The error names file and line.
/// A record that just stops (no last line, or half a line at the end) is no error: the run counts
/// as interrupted, `end_s` is the time of the last event, and so is the open segment's.
/// Unknown events and keys are skipped; another format version is an error.
[[nodiscard]] Expected<RunRecord> read_record(const std::filesystem::path& path);

/// The same of its first `bytes` bytes, which end with a line; the error says that they do not.
[[nodiscard]] Expected<RunRecord> read_record_until(const std::filesystem::path& path,
                                                    std::uint64_t bytes);

}  // namespace canopeer
