#pragma once

#include <kdl/chain.hpp>

#include "canopeer/robot/robot_model.h"

namespace canopeer {

inline KDL::Frame kdl_frame(const Pose& T) {
  KDL::Frame frame;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) frame.M(r, c) = T.linear()(r, c);
    frame.p(r) = T.translation()[r];
  }
  return frame;
}

inline Pose pose_of(const KDL::Frame& frame) {
  Pose T = Pose::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) T.linear()(r, c) = frame.M(r, c);
    T.translation()[r] = frame.p(r);
  }
  return T;
}

/// The description's joints between two links as KDL takes them, read from the description alone.
/// `names` receives the moving joints.
inline KDL::Chain kdl_chain(const RobotDescription& robot, const std::string& from,
                            const std::string& to, std::vector<std::string>* names = nullptr) {
  std::vector<const Joint*> joints;
  for (std::string link = to; link != from;) {
    for (const Joint& joint : robot.joints) {
      if (joint.child != link) continue;
      joints.insert(joints.begin(), &joint);
      link = joint.parent;
      break;
    }
  }
  KDL::Chain chain;
  for (const Joint* joint : joints) {
    const KDL::Frame frame = kdl_frame(joint->T_parent_joint);
    const Vec3 a = joint->T_parent_joint.linear() * joint->axis;
    const KDL::Vector axis(a.x(), a.y(), a.z());
    if (joint->type == JointType::kFixed) {
      chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), frame));
      continue;
    }
    const auto type =
        joint->type == JointType::kPrismatic ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
    chain.addSegment(
        KDL::Segment(joint->name, KDL::Joint(joint->name, frame.p, axis, type), frame));
    if (names != nullptr) names->push_back(joint->name);
  }
  return chain;
}

inline KDL::JntArray kdl_joints(const Configuration& q) {
  KDL::JntArray joints(static_cast<unsigned>(q.size()));
  for (int i = 0; i < q.size(); ++i) joints(static_cast<unsigned>(i)) = q[i];
  return joints;
}

}  // namespace canopeer
