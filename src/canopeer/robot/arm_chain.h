#pragma once

#include <vector>

#include "canopeer/robot/configuration.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Forward kinematics of the links an arm moves, compiled from the description: rotations of the
/// fixed parts that only swap axes cost nothing, and all joints' sines and cosines are computed
/// together. Immutable once built, so safe to share between threads; allocates nothing.
class ArmChain {
 public:
  /// Appends a segment. `parent`: an earlier segment, or −1 for the frame the chain hangs on.
  /// `arm_joint`: which entry of a configuration drives it; −1: a fixed joint. Returns its index.
  int add(int parent, const Pose& T_parent_joint, JointType type, const Vec3& axis, int arm_joint);

  [[nodiscard]] int size() const { return static_cast<int>(segments_.size()); }

  /// Poses of all segments, in the frame in which `T_root` gives the one the chain hangs on. `T`
  /// has room for size() poses.
  void poses(const Configuration& q, const Pose& T_root, Pose* T) const;

 private:
  enum class Turn { kSwap, kGeneral };  // the rotation of T_parent_joint
  enum class Motion { kFixed, kAboutX, kAboutY, kAboutZ, kAboutAxis, kAlong };
  struct Segment {
    int parent = -1;
    int arm_joint = -1;
    Turn turn = Turn::kSwap;
    Motion motion = Motion::kFixed;
    int column[3] = {0, 1, 2};         // kSwap: joint axis k is parent axis
    double sign[3] = {1.0, 1.0, 1.0};  // column[k] times sign[k]
    double axis_sign = 1.0;            // kAboutX … kAboutZ: of the axis
    int offset_axis = -1;              // T_parent_joint's translation is along this axis only;
                                       // −1: it has none, 3: along several
    Pose T_parent_joint = Pose::Identity();
    Vec3 axis = Vec3::UnitZ();
  };

  static void turn_swapped(const Segment& segment, const Eigen::Matrix4d& parent, double sine,
                           double cosine, Eigen::Matrix4d& own);
  static void turn_any(const Segment& segment, const Eigen::Matrix4d& parent, double sine,
                       double cosine, Eigen::Matrix4d& own);

  std::vector<Segment> segments_;
};

}  // namespace canopeer
