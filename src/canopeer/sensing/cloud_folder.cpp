#include "canopeer/sensing/cloud_folder.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/pose_layout.h"
#include "canopeer/sensing/files/timed_files.h"
#include "canopeer/sensing/pose_check.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

Expected<std::vector<fs::path>> clouds_in(const fs::path& directory) {
  std::error_code code;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory, code)) {
    if (is_cloud_of_scanner(entry.path())) files.push_back(entry.path());
  }
  if (code) return fail(directory.string() + ": cannot read: " + code.message());
  if (files.empty()) return fail(directory.string() + ": holds no .ply or .pcd files");
  std::sort(files.begin(), files.end());
  return files;
}

// The names as time stamps; nothing when they are other names.
std::optional<std::vector<double>> times_of(const std::vector<fs::path>& files,
                                            const Trajectory& trajectory, double max_gap_s) {
  std::vector<double> times;
  for (const fs::path& file : files) {
    auto time_s = to_number(file.stem().string());
    if (time_s) time_s = seconds_of_stamp(*time_s);
    const bool inside = time_s && *time_s >= trajectory.poses().front().time_s - max_gap_s &&
                        *time_s <= trajectory.poses().back().time_s + max_gap_s;
    if (!inside) return std::nullopt;
    times.push_back(*time_s);
  }
  return times;
}

}  // namespace

Expected<CloudFolder> open_cloud_folder(const fs::path& directory,
                                        const CloudFolderOptions& options) {
  auto files = clouds_in(directory);
  if (!files) return tl::unexpected(files.error());
  CloudFolder folder;
  const fs::path path = options.trajectory.empty() ? trajectory_in(directory) : options.trajectory;
  if (path.empty()) {
    for (fs::path& file : *files) folder.frames.push_back({std::move(file), std::nullopt});
    return folder;
  }
  const auto trajectory = Trajectory::read(path);
  if (!trajectory) return tl::unexpected(trajectory.error());
  const auto& poses = trajectory->poses();
  const auto times = trajectory->timed() ? times_of(*files, *trajectory, options.max_pose_gap_s)
                                         : std::optional<std::vector<double>>();
  folder.poses = {path, trajectory->taken(), trajectory->order_is_said(), trajectory->notices()};
  if (times) add_motion_notice(*trajectory, folder.poses);
  if (!times && poses.size() != files->size()) {
    return fail(path.string() + ": has " + std::to_string(poses.size()) + " poses for " +
                std::to_string(files->size()) +
                " clouds; expected one per cloud, or clouds named by time stamps");
  }
  for (std::size_t i = 0; i < files->size(); ++i) {
    const auto pose = times ? trajectory->at((*times)[i], options.max_pose_gap_s)
                            : std::optional<Pose>(poses[i].T_world_camera);
    if (pose) {
      folder.frames.push_back({std::move((*files)[i]), pose});
    } else {
      folder.gaps.add((*times)[i]);
    }
  }
  if (folder.frames.empty()) {
    return fail(path.string() + ": no cloud has a pose within " +
                std::to_string(options.max_pose_gap_s) + " s of its time stamp");
  }
  return folder;
}

Expected<PosedCloud> load_cloud(const CloudFolder& folder, std::size_t i) {
  const CloudFrame& frame = folder.frames[i];
  auto file = read_cloud(frame.file);
  if (!file) return tl::unexpected(file.error());
  const std::optional<Pose> pose =
      frame.T_world_points ? frame.T_world_points : file->T_world_points;
  if (!pose && folder.frames.size() > 1) {
    return fail(
        frame.file.string() +
        ": nobody says where it was taken; put poses.txt (`timestamp tx ty tz qx qy qz qw`, "
        "a line per cloud) beside it, or a VIEWPOINT into each PCD file");
  }
  return PosedCloud{*std::move(file), pose.value_or(Pose::Identity())};
}

}  // namespace canopeer
