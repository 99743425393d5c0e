#pragma once

#include <vector>

#include "canopeer/robot/configuration.h"
#include "canopeer/robot/robot_description.h"

namespace canopeer {

/// Forward kinematics of the links an arm moves, compiled from the description. Rotations of the
/// fixed parts that only swap axes cost nothing. All joints' sines and cosines are computed
/// together. Immutable once built, so safe to share between threads; allocates nothing.
class ArmChain {
 public:
  /// Most joints that may follow arm joints.
  static constexpr int kMaxFollowers = 22;

  /// `dof`: how many entries a configuration has.
  explicit ArmChain(int dof = 0) : dof_(dof) {}

  /// Appends a segment. `parent`: an earlier segment, or −1 for the frame the chain hangs on.
  /// `drive`: which entry of a configuration drives it, or what add_follower() gave; −1: a fixed
  /// joint. Returns its index.
  int add(int parent, const Pose& T_parent_joint, JointType type, const Vec3& axis, int drive);

  /// A drive at multiplier · (entry `arm_joint` of a configuration) + offset; at most
  /// kMaxFollowers.
  int add_follower(int arm_joint, double multiplier, double offset);

  [[nodiscard]] int size() const { return static_cast<int>(segments_.size()); }

  /// Poses of all segments, in the frame in which `T_root` gives the one the chain hangs on. `T`
  /// has room for size() poses.
  void poses(const Configuration& q, const Pose& T_root, Pose* T) const;

 private:
  /// How a segment's axes follow from its parent's. In the first two the fixed part only swaps
  /// axes.
  enum class Kind { kSwap, kSwapAndTurn, kAny };
  struct Segment {
    int parent = -1;
    int drive = 0;  // 0 too where there is none
    Kind kind = Kind::kSwap;
    bool slides = false;
    // Axis axis[k] / 4 is sign[k] times the parent's from[k] / 4 (places in a matrix of four rows).
    // A turn leads from axis[0] to axis[1], about axis[2].
    int axis[3] = {0, 1, 2};
    int from[3] = {0, 1, 2};
    double sign[3] = {1.0, 1.0, 1.0};
    double turn_sign = 1.0;
    int offset_axis = -1;  // T_parent_joint's translation is along this axis only; −1: it has
                           // none, 3: along several
    double offset[3] = {0.0, 0.0, 0.0};
    double along[3] = {0.0, 0.0, 0.0};  // of a linear axis, own frame
  };
  struct General {  // of segments whose axes do more than swap
    Pose T_parent_joint = Pose::Identity();
    Vec3 axis = Vec3::UnitZ();
    bool fixed = true;
    bool turns = false;
  };

  struct Follower {
    int arm_joint = 0;
    double multiplier = 1.0;
    double offset = 0.0;
  };

  struct Motions {  // of all drives: positions, and their sines and cosines
    const double* q;
    const double* sines;
    const double* cosines;
  };
  void follow(const Motions& motions, const Pose& T_root, Pose* T) const;
  void follow_wide(const Motions& motions, const Pose& T_root, Pose* T) const;
  void follow_narrow(const Motions& motions, const Pose& T_root, Pose* T) const;
  void turn_any(std::size_t segment, const Eigen::Matrix4d& parent, double sine, double cosine,
                Eigen::Matrix4d& own) const;

  int dof_;
  std::vector<Follower> followers_;  // drives dof_, dof_ + 1, …
  std::vector<Segment> segments_;
  std::vector<General> general_;  // parallel to it
};

}  // namespace canopeer
