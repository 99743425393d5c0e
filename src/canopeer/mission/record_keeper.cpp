#include "canopeer/mission/record_keeper.h"

#include <utility>

#include "canopeer/record/fruit_course.h"

namespace canopeer {
namespace {

/// What each event means for a record. Most of what watchers want to see is not in it.
struct Line {
  RecordWriter& writer;
  RunRecord& record;

  Expected<void> operator()(const SegmentBegun& e) {
    record.segments.push_back(e.segment);
    return writer.begin_segment(e.segment);
  }
  Expected<void> operator()(const SegmentEnded& e) {
    record.segments.back().end_s = e.end_s;
    return writer.end_segment(e.segment, e.end_s);
  }
  Expected<void> operator()(const FrameTaken& e) {
    record.views.push_back(e.view);
    return writer.add(e.view);
  }
  Expected<void> operator()(const FrameOnTheWay& e) {
    record.frames.push_back(e.frame);
    return writer.add(e.frame);
  }
  Expected<void> operator()(const MotionEnded& e) {
    record.motions.push_back(e.motion);
    return writer.add(e.motion);
  }
  Expected<void> operator()(const Steered& e) {
    record.steering.push_back(
        {e.t_s, e.segment, std::string(steering_name(e.word.kind)), e.word.by, e.word.why});
    return writer.add(record.steering.back());
  }
  Expected<void> operator()(const Fault& e) {
    record.faults.push_back({e.t_s, e.message});
    return writer.add(record.faults.back());
  }
  Expected<void> operator()(const WorkDone& e) {
    record.work = e.work;  // sums: the last ones are written
    record.time = e.time;
    return {};
  }
  Expected<void> operator()(const RunEnded& e) {
    record.end_s = e.end_s;
    record.interrupted = e.interrupted;
    if (auto ok = writer.set_work(record.work); !ok) return ok;
    if (record.time) {
      if (auto ok = writer.set_time(*record.time); !ok) return ok;
    }
    return writer.finish(e.end_s, e.interrupted);
  }
  template <typename Other>
  Expected<void> operator()(const Other&) {
    return {};
  }
};

}  // namespace

Expected<RecordKeeper> RecordKeeper::create(const std::filesystem::path& run_dir,
                                            const RunHeader& header) {
  auto writer = RecordWriter::create(run_dir, header);
  if (!writer) return tl::unexpected(writer.error());
  RunRecord record;
  record.header = header;
  return RecordKeeper(std::move(*writer), std::move(record));
}

Expected<RecordKeeper> RecordKeeper::resume(const std::filesystem::path& run_dir,
                                            const RunHeader& header, std::uint64_t bytes) {
  // All is read before anything is cut off.
  auto record = read_record_until(run_dir, bytes);
  if (!record) return tl::unexpected(record.error());
  const RunHeader& there = record->header;
  if (there.mission != header.mission || there.planner != header.planner ||
      there.seed != header.seed || there.canopeer_version != header.canopeer_version) {
    return fail((run_dir / "record").string() + ": is of another run: " + there.mission + " " +
                there.planner + " seed " + std::to_string(there.seed) + ", canopeer " +
                there.canopeer_version);
  }
  const std::vector<FruitsAtTime> course = fruit_course(*record);
  auto writer = RecordWriter::resume(
      run_dir, bytes, course.empty() ? std::vector<FruitSnapshot>() : *course.back().fruits);
  if (!writer) return tl::unexpected(writer.error());
  record->header = header;
  return RecordKeeper(std::move(*writer), std::move(*record));
}

Expected<void> RecordKeeper::on_event(const Event& event) {
  return std::visit(Line{writer_, record_}, event);
}

}  // namespace canopeer
