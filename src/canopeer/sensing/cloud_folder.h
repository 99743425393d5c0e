#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/sensing/cloud_file.h"
#include "canopeer/sensing/pose_source.h"
#include "canopeer/sensing/trajectory.h"

namespace canopeer {

/// Where the poses of a folder of clouds come from.
struct CloudFolderOptions {
  double max_pose_gap_s = 0.25;  ///< between the poses before and after a cloud
  /// Empty: the folder's own (poses.txt, trajectory.txt …), if there is one.
  std::filesystem::path trajectory;
};

/// One cloud of a folder: its file, and where its sensor was.
struct CloudFrame {
  std::filesystem::path file;
  /// Nothing: the file itself says it (VIEWPOINT of PCD).
  std::optional<Pose> T_world_points;
};

/// A plain folder of recorded clouds, each in the frame of the sensor that took it.
struct CloudFolder {
  std::vector<CloudFrame> frames;  ///< sorted by name
  PoseGaps gaps;                   ///< clouds that are no frames
  PoseSource poses;                ///< its file is empty when the clouds say their poses themselves
};

/// Finds the `.ply` and `.pcd` files of a folder and their poses. With a trajectory there are two
/// ways. When every name (without ending) is a number within the trajectory's time, it is the time
/// stamp. Else the n-th cloud has the n-th pose, and there must be as many of each. Without a
/// trajectory each file must say its pose itself. Error: there are no clouds, or no poses for any.
[[nodiscard]] Expected<CloudFolder> open_cloud_folder(const std::filesystem::path& directory,
                                                      const CloudFolderOptions& options = {});

/// The cloud with its pose. Fails when nobody says it; the only cloud of a folder is taken to be in
/// the world frame then.
struct PosedCloud {
  CloudFile file;
  Pose T_world_points = Pose::Identity();
};
[[nodiscard]] Expected<PosedCloud> load_cloud(const CloudFolder& folder, std::size_t i);

}  // namespace canopeer
