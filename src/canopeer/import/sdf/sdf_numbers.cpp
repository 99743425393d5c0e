#include "canopeer/import/sdf/sdf_numbers.h"

#include <cmath>
#include <numbers>

#include "canopeer/base/text_lines.h"

namespace canopeer {
namespace {

constexpr std::size_t kShown = 60;  // of a text in a message

tl::unexpected<Error> not_the_numbers(const SdfElement& element, const std::string& expected) {
  std::string found = element.text().substr(0, kShown);
  for (char& c : found) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return fail(element.where() + ": <" + std::string(element.tag()) + ">: expected " + expected +
              ", found '" + found + "'");
}

/// All of them, if all words are finite numbers.
std::optional<std::vector<double>> finite_numbers(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(text, " \t\r\n")) {
    const auto number = to_number(word);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

/// Turns about the fixed axes: x first, z last.
Eigen::Quaterniond from_angles(double roll, double pitch, double yaw) {
  const auto half = [](double angle) {
    return Eigen::Vector2d(std::cos(angle / 2), std::sin(angle / 2));
  };
  const Eigen::Vector2d r = half(roll);
  const Eigen::Vector2d p = half(pitch);
  const Eigen::Vector2d y = half(yaw);
  return {r[0] * p[0] * y[0] + r[1] * p[1] * y[1], r[1] * p[0] * y[0] - r[0] * p[1] * y[1],
          r[0] * p[1] * y[0] + r[1] * p[0] * y[1], r[0] * p[0] * y[1] - r[1] * p[1] * y[0]};
}

}  // namespace

Expected<std::vector<double>> sdf_numbers(const SdfElement& element, std::size_t least) {
  auto numbers = finite_numbers(element.text());
  if (numbers && numbers->size() >= least) return std::move(*numbers);
  return not_the_numbers(element, least == 1 ? "a number" : std::to_string(least) + " numbers");
}

Expected<double> sdf_number(const SdfElement& parent, const char* tag, double fallback) {
  const SdfElement element = parent.child(tag);
  if (!element || element.text().empty()) return fallback;
  const auto numbers = sdf_numbers(element, 1);
  if (!numbers) return tl::unexpected(numbers.error());
  return numbers->front();
}

Expected<Vec3> sdf_vector(const SdfElement& parent, const char* tag, const Vec3& fallback) {
  const SdfElement element = parent.child(tag);
  if (!element || element.text().empty()) return fallback;
  const auto numbers = sdf_numbers(element, 3);
  if (!numbers) return tl::unexpected(numbers.error());
  return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

bool sdf_truth(const std::string& text) {
  return text == "true" || text == "1" || text == "True" || text == "TRUE";
}

Expected<Pose> sdf_pose(const SdfElement& pose) {
  const std::string text = pose.text();
  if (text.empty()) return Pose::Identity();
  const std::string format = pose.attribute("rotation_format").value_or("euler_rpy");
  const bool quaternion = format == "quat_xyzw";
  if (!quaternion && format != "euler_rpy") {
    return fail(pose.where() + ": <pose rotation_format=\"" + format +
                "\">: expected euler_rpy or quat_xyzw");
  }
  const auto n = finite_numbers(text);
  if (!n || n->size() != (quaternion ? 7U : 6U)) {
    return not_the_numbers(pose, quaternion ? "seven numbers: x y z, and a quaternion x y z w"
                                            : "six numbers: x y z roll pitch yaw");
  }
  const std::vector<double>& v = *n;
  Eigen::Quaterniond q;
  if (quaternion) {
    q = Eigen::Quaterniond(v[6], v[3], v[4], v[5]);
  } else {
    const bool degrees = sdf_truth(pose.attribute("degrees").value_or("false"));
    const double unit = degrees ? std::numbers::pi / 180.0 : 1.0;
    q = from_angles(v[3] * unit, v[4] * unit, v[5] * unit);
  }
  if (!(q.norm() > 1e-9 && std::isfinite(q.norm())))
    return not_the_numbers(pose, "a quaternion of length 1");
  Pose T = Pose::Identity();
  T.translation() = Vec3(v[0], v[1], v[2]);
  T.linear() = q.normalized().toRotationMatrix();
  return T;
}

}  // namespace canopeer
