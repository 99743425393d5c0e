#include "canopeer/sensing/tum_sequence.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/pose_layout.h"
#include "canopeer/sensing/files/timed_files.h"
#include "canopeer/sensing/pose_check.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

constexpr char kAssociations[] = "associations.txt";
constexpr char kDepthList[] = "depth.txt";
constexpr char kColorList[] = "rgb.txt";
constexpr char kDepthFolder[] = "depth";

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

std::vector<fs::path> depth_images_in(const fs::path& directory) {
  std::error_code code;
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(directory / kDepthFolder, code)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".png" || ending == ".pgm") images.push_back(entry.path());
  }
  return images;
}

// Without a list: the images of the folder `depth`. Names that are numbers are time stamps.
std::vector<AssociatedFiles> from_folder(const fs::path& directory) {
  std::vector<TimedFile> depth;
  bool numbers = true;
  for (const fs::path& image : depth_images_in(directory)) {
    const auto stamp = to_number(image.stem().string());
    numbers &= stamp && std::isfinite(*stamp);
    const fs::path file = fs::path(kDepthFolder) / image.filename();
    depth.push_back({seconds_of_stamp(stamp.value_or(0.0)), file.string(), 0});
  }
  std::sort(depth.begin(), depth.end(), [&](const TimedFile& a, const TimedFile& b) {
    return numbers && a.time_s != b.time_s ? a.time_s < b.time_s : a.file < b.file;
  });
  std::vector<AssociatedFiles> all;
  for (TimedFile& image : depth) {
    if (!numbers) image.time_s = static_cast<double>(all.size());
    TimedFile color;
    for (const char* folder : {"rgb", "color"}) {
      const fs::path file = folder / fs::path(image.file).filename().replace_extension(".png");
      if (is_there(directory / file)) color = {image.time_s, file.string(), 0};
    }
    all.push_back({std::move(image), std::move(color)});
  }
  return all;
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
  return is_there(directory / kDepthList) || is_there(directory / kAssociations) ||
         !depth_images_in(directory).empty();
}

Expected<TumSequence> open_tum_sequence(const fs::path& directory, const TumOptions& options) {
  const Expected<std::vector<AssociatedFiles>> images =
      is_there(directory / kAssociations) ? from_associations(directory)
      : is_there(directory / kDepthList)  ? from_lists(directory, options.max_difference_s)
                                          : from_folder(directory);
  if (!images) return tl::unexpected(images.error());
  if (images->empty()) return fail(directory.string() + ": the sequence has no depth images");
  const fs::path found = trajectory_in(directory, {"groundtruth.txt"});
  const fs::path path = !options.trajectory.empty() ? options.trajectory
                        : found.empty()             ? directory / "groundtruth.txt"
                                                    : found;
  const auto trajectory = Trajectory::read(path);
  if (!trajectory) return tl::unexpected(trajectory.error());

  TumSequence sequence;
  sequence.poses = {path, trajectory->taken(), trajectory->order_is_said(), trajectory->notices()};
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
