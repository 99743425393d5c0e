#include "canopeer/sensing/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/plain_text.h"
#include "canopeer/base/text_lines.h"
#include "canopeer/sensing/files/pose_layout.h"
#include "canopeer/sensing/files/table_dialect.h"

namespace canopeer {
namespace {

constexpr std::string_view kSeparators = " \t,;\"";

bool are_numbers(const Words& words) {
  return std::all_of(words.begin(), words.end(),
                     [](std::string_view word) { return to_number(word).has_value(); });
}

/// Lines with something on them; comments may name columns.
struct PoseLines {
  std::vector<std::pair<int, Words>> lines;
  std::optional<PoseLayout> head;
};

PoseLines pose_lines(std::string_view text) {
  PoseLines result;
  TextLines lines(text);
  while (const auto line = lines.next()) {
    const auto comment = comment_of(*line);
    Words words = words_of(*line, kSeparators);
    if (words.empty()) continue;
    if (result.lines.empty() && (comment || !are_numbers(words))) {
      if (auto head = layout_of_head(names_in(comment.value_or(*line)))) {
        result.head = std::move(head);
        continue;
      }
    }
    if (!comment) result.lines.emplace_back(lines.number(), std::move(words));
  }
  return result;
}

/// Matrices of three or four lines of four numbers. What stands between them counts them.
Expected<std::vector<TimedPose>> poses_of_blocks(const PoseLines& text, const std::string& name) {
  std::vector<TimedPose> poses;
  std::array<double, 12> matrix{};
  std::size_t rows = 0;
  for (const auto& [number, words] : text.lines) {
    const auto here = [&, line = number](const std::string& message) {
      return fail(name + ":" + std::to_string(line) + ": " + message);
    };
    if (!are_numbers(words)) return here("expected the numbers of a matrix");
    if (words.size() != 4) {
      if (words.size() > 3 || rows != 0) return here("expected 4 numbers, a line of a matrix");
      continue;
    }
    std::array<double, 4> row{};
    for (std::size_t i = 0; i < 4; ++i) row[i] = *to_number(words[i]);
    const bool last_row = row == std::array<double, 4>{0.0, 0.0, 0.0, 1.0};
    if (rows == 0 && last_row && !poses.empty()) continue;
    std::copy(row.begin(), row.end(), matrix.begin() + static_cast<std::ptrdiff_t>(4 * rows));
    if (++rows < 3) continue;
    rows = 0;
    const auto pose = pose_of_matrix(matrix);
    if (!pose) return here(pose.error().message);
    poses.push_back({static_cast<double>(poses.size()), *pose});
  }
  if (rows != 0) return fail(name + ": ends within a matrix: the file was cut off");
  return poses;
}

Pose between(const TimedPose& a, const TimedPose& b, double time_s) {
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  const Eigen::Quaterniond qa(a.T_world_camera.linear());
  const Eigen::Quaterniond qb(b.T_world_camera.linear());
  Pose pose = Pose::Identity();
  pose.linear() = qa.slerp(share, qb).toRotationMatrix();
  pose.translation() =
      (1.0 - share) * a.T_world_camera.translation() + share * b.T_world_camera.translation();
  return pose;
}

}  // namespace

Expected<Trajectory> Trajectory::read(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse(*text, path.string());
}

Expected<Trajectory> Trajectory::parse(std::string_view text, const std::string& name) {
  const PlainText plain(text);
  if (!plain.is_text()) return fail(name + ": holds zero bytes: it is no text");
  const PoseLines content = pose_lines(plain.view());
  if (content.lines.empty()) {
    return fail(name + ": holds no pose; expected `timestamp tx ty tz qx qy qz qw` in each line");
  }
  const Words& first = content.lines[0].second;
  if (!content.head && std::none_of(first.begin(), first.end(), to_number)) {
    return fail(name + ":" + std::to_string(content.lines[0].first) +
                ": names no position and quaternion; expected columns such as timestamp, tx, ty, "
                "tz, qx, qy, qz, qw");
  }
  Trajectory trajectory;
  const std::size_t width = first.size();
  if (!content.head && (width == 3 || width == 4)) {
    auto poses = poses_of_blocks(content, name);
    if (!poses) return tl::unexpected(poses.error());
    if (poses->empty()) return fail(name + ": holds no pose");
    trajectory.poses_ = *std::move(poses);
    trajectory.timed_ = false;
    trajectory.order_is_said_ = true;
    trajectory.taken_ = "matrices of several lines, no time stamps: one for each frame";
    return trajectory;
  }
  const auto layout = content.head ? content.head : layout_of_width(width);
  if (!layout) {
    return fail(name + ":" + std::to_string(content.lines[0].first) +
                ": expected the 8 numbers `timestamp tx ty tz qx qy qz qw`, got " +
                std::to_string(width) +
                " words; for other columns, name them in a first line (timestamp, tx, ty, tz, qw, "
                "qx, qy, qz)");
  }
  trajectory.timed_ = layout->time != PoseLayout::kNone;
  trajectory.order_is_said_ = layout->order_is_said();
  trajectory.taken_ = layout->taken;
  int repeated = 0, first_repeated = 0;
  for (const auto& [number, words] : content.lines) {
    const std::string place = name + ":" + std::to_string(number);
    auto pose = pose_of(words, *layout);
    if (!pose) return fail_in(place, pose.error());
    if (!trajectory.timed_) pose->time_s = static_cast<double>(trajectory.poses_.size());
    const double after_s = trajectory.poses_.empty() ? -INFINITY : trajectory.poses_.back().time_s;
    if (pose->time_s == after_s) {
      if (repeated++ == 0) first_repeated = number;
      continue;
    }
    if (!(pose->time_s > after_s)) {
      return fail(place + ": the time stamp is earlier than the one before; sort the lines");
    }
    trajectory.poses_.push_back(*pose);
  }
  if (repeated > 0) {
    trajectory.notices_.push_back(name + ":" + std::to_string(first_repeated) + ": " +
                                  std::to_string(repeated) +
                                  " poses left out: the pose before has the same time stamp");
  }
  return trajectory;
}

bool Trajectory::counts_frames() const {
  const double first = poses_.front().time_s;
  if (!timed_ || poses_.size() < 2 || (first != 0.0 && first != 1.0)) return false;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (poses_[i].time_s != first + static_cast<double>(i)) return false;
  }
  return true;
}

std::optional<Pose> Trajectory::at(double time_s, double max_gap_s) const {
  const auto next =
      std::lower_bound(poses_.begin(), poses_.end(), time_s,
                       [](const TimedPose& pose, double time) { return pose.time_s < time; });
  if (next == poses_.end()) return std::nullopt;
  if (next->time_s == time_s) return next->T_world_camera;
  if (next == poses_.begin() || next->time_s - std::prev(next)->time_s > max_gap_s) {
    return std::nullopt;
  }
  return between(*std::prev(next), *next, time_s);
}

}  // namespace canopeer
