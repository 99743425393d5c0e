#pragma once

#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/import/sdf/sdf_element.h"

namespace canopeer {

// What SDF elements hold as text. Numbers are finite; an error says the file, the line, what was
// expected and what was found. No such child: the fallback.

/// At least `least` numbers.
[[nodiscard]] Expected<std::vector<double>> sdf_numbers(const SdfElement& element,
                                                        std::size_t least);

[[nodiscard]] Expected<double> sdf_number(const SdfElement& parent, const char* tag,
                                          double fallback);

[[nodiscard]] Expected<Vec3> sdf_vector(const SdfElement& parent, const char* tag,
                                        const Vec3& fallback);

/// "true" and "1" are true.
[[nodiscard]] bool sdf_truth(const std::string& text);

/// What a <pose> says: x y z in metres, then roll pitch yaw in radians, in degrees by its attribute
/// `degrees`, or the quaternion x y z w by `rotation_format`. Of no or an empty <pose> the
/// identity. To what it is relative is not looked at.
[[nodiscard]] Expected<Pose> sdf_pose(const SdfElement& pose);

}  // namespace canopeer
