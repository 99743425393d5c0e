#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "canopeer/scene/scene.h"
#include "canopeer/sensing/camera_intrinsics.h"

namespace canopeer {

/// A number over what runs in a world depend on besides seed, planner and protocol: the scene
/// (scene_hash()), the robot's files as text, the camera. FNV-1a, the same on every machine.
[[nodiscard]] std::uint64_t world_hash(const Scene& scene, std::span<const std::string> robot_files,
                                       const CameraIntrinsics& camera);

/// Sixteen hexadecimal digits.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace canopeer
