#include "canopeer/ros2/camera/frame_poses.h"

#include <cstdio>
#include <limits>

#include "canopeer/base/check.h"

namespace canopeer::ros {
namespace {

std::string offset_text(std::int64_t ns) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f s", seconds(ns));
  return text;
}

class JointPoses : public FramePoses {
 public:
  JointPoses(const RobotModel& robot, const JointHistory& joints, TrolleyAt trolley)
      : robot_(robot), joints_(joints), trolley_(std::move(trolley)) {}

  Expected<Pose> at(Stamp stamp, const std::string&) const override {
    if (const auto positions = joints_.at(stamp)) {
      return robot_.T_world_base(trolley_(stamp)) *
             robot_.T_base_camera(arm_configuration(robot_, joints_, *positions));
    }
    const auto oldest = joints_.oldest(), newest = joints_.newest();
    if (!oldest || !newest) return fail("not all joints of the arm are in the joint states");
    if (stamp > *newest) {
      return fail("joint states end " + offset_text(stamp - *newest) +
                  " before the image's stamp: is the camera's clock ahead (time_offset_s)?");
    }
    if (stamp < *oldest) {
      return fail("joint states begin " + offset_text(*oldest - stamp) +
                  " after the image's stamp: is the camera's clock behind (time_offset_s)?");
    }
    return fail("joint states have a gap of more than 0.5 s at the image's stamp");
  }
  std::optional<Stamp> known_until(const std::string&) const override { return joints_.newest(); }

 private:
  const RobotModel& robot_;
  const JointHistory& joints_;
  const TrolleyAt trolley_;
};

class TfPoses : public FramePoses {
 public:
  TfPoses(const RobotModel& robot, const TfBuffer& tf, std::string base_frame,
          std::string optical_frame, TrolleyAt trolley)
      : robot_(robot),
        tf_(tf),
        base_(std::move(base_frame)),
        optical_(std::move(optical_frame)),
        trolley_(std::move(trolley)) {}

  Expected<Pose> at(Stamp stamp, const std::string& frame_id) const override {
    const auto T_base_camera = tf_.lookup(base_, optical(frame_id), stamp);
    if (!T_base_camera) return T_base_camera;
    return robot_.T_world_base(trolley_(stamp)) * *T_base_camera;
  }
  std::optional<Stamp> known_until(const std::string& frame_id) const override {
    const auto until = tf_.known_until(base_, optical(frame_id));
    if (until || !tf_.newest(base_, optical(frame_id))) return until;
    return std::numeric_limits<Stamp>::max();  // static: known for all times
  }

 private:
  [[nodiscard]] const std::string& optical(const std::string& frame_id) const {
    return optical_.empty() ? frame_id : optical_;
  }
  const RobotModel& robot_;
  const TfBuffer& tf_;
  const std::string base_, optical_;
  const TrolleyAt trolley_;
};

}  // namespace

std::unique_ptr<FramePoses> poses_of_joints(const RobotModel& robot, const JointHistory& joints,
                                            TrolleyAt trolley) {
  return std::make_unique<JointPoses>(robot, joints, std::move(trolley));
}

std::unique_ptr<FramePoses> poses_of_tf(const RobotModel& robot, const TfBuffer& tf,
                                        std::string base_frame, std::string optical_frame,
                                        TrolleyAt trolley) {
  return std::make_unique<TfPoses>(robot, tf, std::move(base_frame), std::move(optical_frame),
                                   std::move(trolley));
}

Configuration arm_configuration(const RobotModel& robot, const JointHistory& joints,
                                const std::vector<double>& positions) {
  const auto& names = robot.setup().arm_joints;
  Configuration q(static_cast<Eigen::Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int index = joints.index(names[i]);
    CANOPEER_CHECK(index >= 0, "the history has all joints of the arm");
    q[static_cast<Eigen::Index>(i)] = positions[static_cast<std::size_t>(index)];
  }
  return q;
}

}  // namespace canopeer::ros
