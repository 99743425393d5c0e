#include "canopeer/sensing/files/pose_layout.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/table_dialect.h"

namespace canopeer {
namespace {

constexpr char kExpected[] = "expected the 8 numbers `timestamp tx ty tz qx qy qz qw`";

/// A column's name in parts: small letters, without the unit.
struct NameParts {
  std::vector<std::string> parts;
  std::string unit;
};

NameParts parts_of(std::string_view name) {
  NameParts result;
  const std::size_t bracket = name.find_first_of("[(");
  if (bracket != std::string_view::npos) {
    const std::size_t end = name.find_first_of("])", bracket);
    result.unit = name.substr(bracket + 1, end - bracket - 1);
    name = name.substr(0, bracket);
  }
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const auto part : words_of(lower, " _.:/-\t\"'")) result.parts.emplace_back(part);
  return result;
}

bool any_of(const std::vector<std::string>& parts, const std::set<std::string>& words) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return words.count(part) > 0; });
}

/// What else has an x: velocities, biases, angles.
bool is_something_else(const std::vector<std::string>& parts) {
  static const std::set<std::string> kOthers = {
      "v",     "vel",        "velocity",     "vx",   "vy",    "vz",      "b",      "bias",
      "a",     "acc",        "acceleration", "w",    "omega", "angular", "linear", "twist",
      "euler", "covariance", "cov",          "gyro", "bw",    "ba",      "sigma",  "std"};
  return std::any_of(parts.begin(), parts.end() - 1,
                     [&](const std::string& part) { return kOthers.count(part) > 0; });
}

/// Of the last part of the name the axis, 0 … 3 for x y z w; glued to what it is of: qx, tx, px.
std::optional<std::size_t> axis_of(const std::string& last, std::string* of) {
  constexpr std::string_view kAxes = "xyzw";
  if (last.empty() || last.size() > 4) return std::nullopt;
  const std::size_t axis = kAxes.find(last.back());
  if (axis == std::string_view::npos) return std::nullopt;
  *of = last.substr(0, last.size() - 1);
  static const std::set<std::string> kGlued = {"", "q", "t", "p", "pos", "rot"};
  if (kGlued.count(*of) == 0) return std::nullopt;
  return axis;
}

std::optional<double> time_unit(const NameParts& name) {
  static const std::set<std::string> kTimes = {"timestamp", "timestamps", "time", "stamp",
                                               "t",         "seconds",    "ts"};
  // Half of a stamp is none.
  static const std::set<std::string> kHalves = {"sec", "secs", "nsec", "nsecs", "nanosec"};
  if (!any_of(name.parts, kTimes) || kHalves.count(name.parts.back()) > 0) return std::nullopt;
  const auto says = [&](const char* unit) {
    return name.unit == unit || name.parts.back() == unit;
  };
  if (says("ns")) return 1e-9;
  if (says("us")) return 1e-6;
  if (says("ms")) return 1e-3;
  if (name.unit == "s") return 1.0;
  return 0.0;
}

struct FoundColumns {
  std::array<std::size_t, 3> t;
  std::array<std::size_t, 4> q;
  FoundColumns() {
    t.fill(PoseLayout::kNone);
    q.fill(PoseLayout::kNone);
  }
  [[nodiscard]] bool complete() const {
    return std::find(t.begin(), t.end(), PoseLayout::kNone) == t.end() &&
           std::find(q.begin(), q.end(), PoseLayout::kNone) == q.end();
  }
};

void take(std::size_t& place, std::size_t column) {
  if (place == PoseLayout::kNone) place = column;
}

/// True when the name ends as that of an axis does.
bool find_axis(const NameParts& name, std::size_t column, FoundColumns& found) {
  std::string of;
  const auto axis = axis_of(name.parts.back(), &of);
  if (!axis || is_something_else(name.parts)) return axis.has_value();
  static const std::set<std::string> kRotations = {"q",   "quat",     "quaternion", "orientation",
                                                   "rot", "rotation", "attitude"};
  const bool rotation = of == "q" || of == "rot" || any_of(name.parts, kRotations) || *axis == 3;
  if (rotation) {
    take(found.q[*axis], column);
  } else {
    take(found.t[*axis], column);
  }
  return true;
}

Expected<Pose> pose_from_quaternion(const std::vector<double>& v, const PoseLayout& layout) {
  const auto& [x, y, z, w] = layout.q;
  const Eigen::Quaterniond q(v[w], v[x], v[y], v[z]);
  // Files have four digits or so; what is farther off is no rotation.
  if (std::abs(q.norm() - 1.0) > 0.05) {
    return fail("the quaternion qx qy qz qw has length " + std::to_string(q.norm()) +
                ", expected 1 (taken: " + layout.taken + ")");
  }
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = Vec3(v[layout.t[0]], v[layout.t[1]], v[layout.t[2]]);
  return pose;
}

}  // namespace

Words names_in(std::string_view line) {
  for (const char separator : {',', ';'}) {
    if (line.find(separator) != std::string_view::npos) {
      Words names;
      split_fields(line, {separator, false}, names);
      return names;
    }
  }
  Words names;
  for (const auto word : words_of(line)) {
    if (!names.empty() && (word[0] == '[' || word[0] == '(')) {
      names.back() = {names.back().data(),
                      static_cast<std::size_t>(word.data() + word.size() - names.back().data())};
    } else {
      names.push_back(word);
    }
  }
  return names;
}

std::optional<PoseLayout> layout_of_head(const Words& names) {
  PoseLayout layout;
  FoundColumns found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const NameParts name = parts_of(names[i]);
    if (name.parts.empty() || find_axis(name, i, found)) continue;
    const auto unit = time_unit(name);
    // rostopic has %time, the time of writing, before the message's own stamp; both in nanoseconds.
    if (name.parts.front() == "field" && unit) {
      layout.time = i;
      layout.time_unit_s = 1e-9;
    } else if (unit && (layout.time == PoseLayout::kNone || name.parts.back() == "stamp")) {
      layout.time = i;
      layout.time_unit_s = *unit;
    }
  }
  if (!found.complete()) return std::nullopt;
  layout.words = names.size();
  layout.t = found.t;
  layout.q = found.q;
  layout.from_head = true;
  const auto add = [&](std::size_t i) {
    layout.taken += (layout.taken.empty() ? "" : " ") + std::string(names[i]);
  };
  if (layout.time != PoseLayout::kNone) add(layout.time);
  for (const std::size_t i : layout.t) add(i);
  for (const std::size_t i : layout.q) add(i);
  layout.taken += ", as the file names them";
  return layout;
}

std::optional<PoseLayout> layout_of_width(std::size_t words) {
  PoseLayout layout;
  layout.words = words;
  const std::size_t first = words == 8 || words == 13 ? 1 : 0;
  if (first == 1) layout.time = 0;
  if (words == 7 || words == 8) {
    layout.t = {first, first + 1, first + 2};
    layout.q = {first + 3, first + 4, first + 5, first + 6};
    layout.taken = std::string(first == 1 ? "timestamp " : "") + "tx ty tz qx qy qz qw";
  } else if (words == 12 || words == 13 || words == 16) {
    layout.matrix = first;
    layout.taken = std::string(first == 1 ? "timestamp and " : "") +
                   (words == 16 ? "4 × 4" : "3 × 4") + " matrices, row by row";
  } else {
    return std::nullopt;
  }
  if (first == 0) layout.taken += ", no time stamps: one for each frame";
  return layout;
}

Expected<Pose> pose_of_matrix(const std::array<double, 12>& m) {
  Eigen::Matrix3d rotation;
  rotation << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
  const double off = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(off < 0.05)) {
    return fail(
        "the 12 numbers are no 3 × 4 matrix row by row: its first three columns are no rotation");
  }
  if (rotation.determinant() < 0.0) {
    return fail("the matrix mirrors (its determinant is −1): the poses are left-handed");
  }
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  pose.translation() = Vec3(m[3], m[7], m[11]);
  return pose;
}

Expected<TimedPose> pose_of(const Words& words, const PoseLayout& layout) {
  const bool tum = layout.words == 8 && layout.matrix == PoseLayout::kNone && !layout.from_head;
  const std::string expected =
      tum ? kExpected
          : "expected " + std::to_string(layout.words) + " numbers (" + layout.taken + ")";
  if (words.size() != layout.words) {
    return fail(expected + ", got " + std::to_string(words.size()) + " words");
  }
  std::vector<double> v(words.size());
  const auto load = [&](std::size_t i) {
    const auto number = to_number(words[i]);
    v[i] = number.value_or(std::nan(""));
    return std::isfinite(v[i]);
  };
  std::vector<std::size_t> used(layout.t.begin(), layout.t.end());
  used.insert(used.end(), layout.q.begin(), layout.q.end());
  if (layout.matrix != PoseLayout::kNone) {
    used.clear();
    for (std::size_t i = 0; i < 12; ++i) used.push_back(layout.matrix + i);
  }
  if (layout.time != PoseLayout::kNone) used.push_back(layout.time);
  for (const std::size_t i : used) {
    if (!load(i)) {
      return fail(expected + ", got \"" + std::string(words[i].substr(0, 40)) + "\"");
    }
  }
  TimedPose timed;
  if (layout.time != PoseLayout::kNone) {
    const double stamp = v[layout.time];
    timed.time_s = layout.time_unit_s > 0.0 ? stamp * layout.time_unit_s : seconds_of_stamp(stamp);
  }
  std::array<double, 12> matrix{};
  if (layout.matrix != PoseLayout::kNone) {
    std::copy_n(v.begin() + static_cast<std::ptrdiff_t>(layout.matrix), 12, matrix.begin());
  }
  const auto pose =
      layout.matrix != PoseLayout::kNone ? pose_of_matrix(matrix) : pose_from_quaternion(v, layout);
  if (!pose) return tl::unexpected(pose.error());
  timed.T_world_camera = *pose;
  return timed;
}

double seconds_of_stamp(double stamp) {
  constexpr double kTooLate_s = 1e11;  // the year 5138
  double seconds = stamp;
  for (int i = 0; i < 3 && std::abs(seconds) >= kTooLate_s; ++i) seconds /= 1000.0;
  return seconds;
}

}  // namespace canopeer
