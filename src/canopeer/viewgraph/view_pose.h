#pragma once

#include <string_view>

#include "canopeer/geometry/pose.h"
#include "canopeer/robot/robot_model.h"

namespace canopeer {

/// Which frontier a view pose was made for; `none` for the camera's own node.
enum class TargetKind { none, roi, occupied, border };

inline std::string_view target_kind_name(TargetKind kind) {
  switch (kind) {
    case TargetKind::roi:
      return "roi";
    case TargetKind::occupied:
      return "occupied";
    case TargetKind::border:
      return "border";
    case TargetKind::none:
      break;
  }
  return "home";
}

/// A place for the camera that the arm can take up without collision, and what it looks at.
struct ViewPose {
  Configuration q;                         ///< arm joints, rad
  Pose T_world_camera = Pose::Identity();  ///< optical frame
  Vec3 target_world = Vec3::Zero();
  TargetKind kind = TargetKind::none;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(q, T_world_camera, target_world, kind);
  }
};

}  // namespace canopeer
