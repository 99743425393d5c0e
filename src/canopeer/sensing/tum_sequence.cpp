#include "canopeer/sensing/tum_sequence.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "canopeer/base/atomic_file.h"
#include "canopeer/sensing/files/timed_files.h"
#include "canopeer/sensing/pose_check.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

constexpr char kAssociations[] = "associations.txt";
constexpr char kDepthList[] = "depth.txt";
constexpr char kColorList[] = "rgb.txt";
constexpr char kTrajectory[] = "groundtruth.txt";

bool is_there(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code);
}

Expected<void> check_image(const fs::path& directory, const fs::path& list,
                           const TimedFile& image) {
  if (is_there(directory / image.file)) return {};
  return fail(list.string() + ":" + std::to_string(image.line) + ": the image " +
              (directory / image.file).string() + " is not there");
}

Expected<std::vector<AssociatedFiles>> from_associations(const fs::path& directory) {
  const fs::path list = directory / kAssociations;
  const auto text = read_file(list);
  if (!text) return tl::unexpected(text.error());
  auto all = parse_associations(*text, list.string());
  if (!all) return all;
  for (const AssociatedFiles& images : *all) {
    for (const TimedFile* image : {&images.depth, &images.color}) {
      if (auto there = check_image(directory, list, *image); !there) {
        return tl::unexpected(there.error());
      }
    }
  }
  return all;
}

Expected<std::vector<TimedFile>> read_list(const fs::path& directory, const char* name) {
  const fs::path list = directory / name;
  const auto text = read_file(list);
  if (!text) return tl::unexpected(text.error());
  auto files = parse_timed_files(*text, list.string());
  if (!files) return files;
  for (const TimedFile& image : *files) {
    if (auto there = check_image(directory, list, image); !there) {
      return tl::unexpected(there.error());
    }
  }
  return files;
}

// Each depth image with the colour image nearest in time.
Expected<std::vector<AssociatedFiles>> from_lists(const fs::path& directory,
                                                  double max_difference_s) {
  auto depth = read_list(directory, kDepthList);
  if (!depth) return tl::unexpected(depth.error());
  std::vector<TimedFile> color;
  if (is_there(directory / kColorList)) {
    auto list = read_list(directory, kColorList);
    if (!list) return tl::unexpected(list.error());
    color = *std::move(list);
  }
  std::vector<AssociatedFiles> all;
  for (TimedFile& image : *depth) {
    const std::size_t nearest = nearest_in_time(color, image.time_s, max_difference_s);
    all.push_back({std::move(image), nearest < color.size() ? color[nearest] : TimedFile{}});
  }
  return all;
}

/// Poses without time stamps belong to the frames in order; and so do those that are only counted,
/// when no image was taken in that time. There must be as many.
bool goes_by_order(const Trajectory& trajectory, const std::vector<AssociatedFiles>& images,
                   const TumOptions& options) {
  if (trajectory.poses().size() != images.size()) return false;
  if (!trajectory.timed()) return true;
  return trajectory.counts_frames() &&
         std::none_of(images.begin(), images.end(), [&](const AssociatedFiles& image) {
           return trajectory.at(image.depth.time_s, options.max_pose_gap_s).has_value();
         });
}

}  // namespace

bool is_tum_sequence(const fs::path& directory) {
  return is_there(directory / kDepthList) || is_there(directory / kAssociations);
}

Expected<TumSequence> open_tum_sequence(const fs::path& directory, const TumOptions& options) {
  const auto images = is_there(directory / kAssociations)
                          ? from_associations(directory)
                          : from_lists(directory, options.max_difference_s);
  if (!images) return tl::unexpected(images.error());
  if (images->empty()) return fail(directory.string() + ": the sequence has no depth images");
  const fs::path path = options.trajectory.empty() ? directory / kTrajectory : options.trajectory;
  const auto trajectory = Trajectory::read(path);
  if (!trajectory) return tl::unexpected(trajectory.error());

  TumSequence sequence;
  sequence.poses = {path, trajectory->taken(), trajectory->order_is_said(), {}};
  const bool by_order = goes_by_order(*trajectory, *images, options);
  if (!trajectory->timed() && !by_order) {
    return fail(path.string() + ": has " + std::to_string(trajectory->poses().size()) +
                " poses without time stamps for " + std::to_string(images->size()) +
                " depth images; expected one for each");
  }
  for (std::size_t i = 0; i < images->size(); ++i) {
    const AssociatedFiles& observation = (*images)[i];
    const double time_s = observation.depth.time_s;
    const auto pose = by_order ? std::optional<Pose>(trajectory->poses()[i].T_world_camera)
                               : trajectory->at(time_s, options.max_pose_gap_s);
    if (!pose) {
      sequence.gaps.add(time_s);
      continue;
    }
    TumFrame frame{time_s, directory / observation.depth.file, {}, *pose};
    if (observation.color.file.empty()) {
      ++sequence.without_color;
    } else {
      frame.color = directory / observation.color.file;
    }
    sequence.frames.push_back(std::move(frame));
  }
  if (by_order && trajectory->timed()) {
    sequence.poses.notices.push_back(path.string() +
                                     ": the time stamps only count the poses: the n-th was taken "
                                     "for the n-th depth image");
  }
  if (!by_order) add_motion_notice(*trajectory, sequence.poses);
  if (sequence.frames.empty()) {
    return fail(path.string() + ": no depth image has a pose: the trajectory goes from " +
                std::to_string(trajectory->poses().front().time_s) + " s to " +
                std::to_string(trajectory->poses().back().time_s) + " s, the images from " +
                std::to_string(images->front().depth.time_s) + " s to " +
                std::to_string(images->back().depth.time_s) + " s; poses may be as far apart as " +
                std::to_string(options.max_pose_gap_s) + " s");
  }
  return sequence;
}

}  // namespace canopeer
