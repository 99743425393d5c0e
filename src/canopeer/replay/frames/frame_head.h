#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "canopeer/geometry/pose.h"
#include "canopeer/replay/frame.h"
#include "canopeer/sensing/camera_intrinsics.h"

// What the heads of frames are made with. For .cpp files only: it has the JSON library in it.

namespace canopeer::frames {

/// Members stay in the order they are written in, "type" first.
using Json = nlohmann::ordered_json;

inline Json head_of(std::string_view type) { return Json{{"type", type}}; }

inline Frame frame_of(const Json& head, std::string octets = {}) {
  // Names in files may hold any bytes.
  return {head.dump(-1, ' ', false, Json::error_handler_t::replace), std::move(octets)};
}

/// What people can see, not what the machine knows: it keeps replays small.
[[nodiscard]] double rounded(double value, double step);

[[nodiscard]] Json from(const Vec3& v);     ///< to 0.1 mm
[[nodiscard]] Json from(const Pose& pose);  ///< twelve numbers, to 1e-6
[[nodiscard]] Json from(const Box& box);    ///< min, max
[[nodiscard]] Json from(const CameraIntrinsics& camera);
[[nodiscard]] Json from_time(double t_s);  ///< to 1 ms

}  // namespace canopeer::frames
