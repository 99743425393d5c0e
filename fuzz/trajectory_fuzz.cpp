#include <cstddef>
#include <cstdint>

#include "canopeer/sensing/files/timed_files.h"
#include "canopeer/sensing/pose_check.h"
#include "canopeer/sensing/trajectory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto trajectory = canopeer::Trajectory::parse(text, "fuzz")) {
    const double first_s = trajectory->poses().front().time_s;
    const double last_s = trajectory->poses().back().time_s;
    (void)trajectory->at(0.5 * (first_s + last_s), 1.0);
    canopeer::PoseSource source;
    canopeer::add_motion_notice(*trajectory, source);
  }
  if (const auto files = canopeer::parse_timed_files(text, "fuzz")) {
    (void)canopeer::nearest_in_time(*files, 1.0, 0.5);
  }
  (void)canopeer::parse_associations(text, "fuzz");
  return 0;
}
