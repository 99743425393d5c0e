#pragma once

#include <filesystem>

#include "canopeer/mission/listeners.h"
#include "canopeer/record/record_file.h"

namespace canopeer {

/// Keeps the run's record: on disk, line by line, and in memory.
class RecordKeeper : public Keeper {
 public:
  /// Makes the directory and starts the record in it. The error says what cannot be written.
  [[nodiscard]] static Expected<RecordKeeper> create(const std::filesystem::path& run_dir,
                                                     const RunHeader& header);
  /// Goes on with the record in `run_dir` where it was `bytes` long; what was written behind goes.
  /// The error, and nothing is lost: it is no record, or of another run than `header` says.
  [[nodiscard]] static Expected<RecordKeeper> resume(const std::filesystem::path& run_dir,
                                                     const RunHeader& header, std::uint64_t bytes);

  [[nodiscard]] Expected<void> on_event(const Event& event) override;

  /// What was kept so far.
  [[nodiscard]] const RunRecord& record() const { return record_; }
  /// Length of the file so far.
  [[nodiscard]] std::uint64_t bytes() const { return writer_.bytes(); }

 private:
  RecordKeeper(RecordWriter writer, RunRecord record)
      : writer_(std::move(writer)), record_(std::move(record)) {}

  RecordWriter writer_;
  RunRecord record_;
};

}  // namespace canopeer
