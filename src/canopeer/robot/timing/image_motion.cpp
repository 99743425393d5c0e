#include "canopeer/robot/timing/image_motion.h"

#include <algorithm>
#include <cmath>

#include "canopeer/base/check.h"
#include "canopeer/base/hypotenuse.h"
#include "canopeer/sensing/camera_twist.h"

namespace canopeer {
namespace {

/// Bounds on the sizes of a twist.
struct TwistSize {
  double linear = 0.0;
  double angular = 0.0;
};
TwistSize operator+(const TwistSize& a, const TwistSize& b) {
  return {a.linear + b.linear, a.angular + b.angular};
}
TwistSize operator*(double factor, const TwistSize& a) {
  return {factor * a.linear, factor * a.angular};
}
/// Of the Lie bracket: (ω_a × v_b − ω_b × v_a, ω_a × ω_b).
TwistSize bracket(const TwistSize& a, const TwistSize& b) {
  return {a.angular * b.linear + b.angular * a.linear, a.angular * b.angular};
}

}  // namespace

ImageMotion::ImageMotion(const RobotModel& robot, const ImageMotionLimit& limit)
    : robot_(&robot), limit_(limit) {
  CANOPEER_CHECK(limit.distance_m > 0.0, "what is looked at lies before the camera");
  CANOPEER_CHECK(limit.speed_px_s > 0.0, "no motion leaves an image quite still");
}

double ImageMotion::along(const Configuration& q, const Configuration& tangent) const {
  Pose T_base_camera;
  RobotModel::Jacobian jacobian;
  robot_->camera_jacobian(q, T_base_camera, jacobian);
  const Eigen::Matrix<double, 6, 1> twist_base = jacobian * tangent;
  CameraTwist twist;
  twist.linear = T_base_camera.linear().transpose() * twist_base.head<3>();
  twist.angular = T_base_camera.linear().transpose() * twist_base.tail<3>();
  return image_speed(twist, limit_.camera, limit_.distance_m);
}

// With a_k the camera's twist per unit of mover k, in camera coordinates, and r_k that mover's
// rate: V = Σ a_k r_k, and a_k changes with the movers after it only,
// a_k' = [a_k, Σ_{m>k} a_m r_m] (Müller, "Screw and Lie group theory in multibody kinematics",
// Multibody System Dynamics 43, 2018). So with S_k = Σ_{m>k} a_m r_m:
//   V'' = Σ a_k r_k'' + 2 a_k' r_k' + a_k'' r_k,  a_k'' = [a_k', S_k] + [a_k, S_k'].
double ImageMotion::bend(const BlendedPath::Piece& piece) const {
  const int camera = robot_->link_index(robot_->setup().camera_frame);
  const std::vector<RobotModel::Hop> hops = robot_->arm_hops(camera);
  const double curvature = piece.radius > 0.0 ? 1.0 / piece.radius : 0.0;
  double way = 0.0;  // from the mover's frame to the camera, at most
  TwistSize after;   // S_k
  TwistSize after_changes;
  TwistSize bends;
  for (std::size_t k = hops.size(); k-- > 0;) {
    const RobotModel::Hop& hop = hops[k];
    const Vec3 aside = hop.offset - hop.offset.dot(hop.axis) * hop.axis;
    const double lever = way + hop.slide + (hop.slides ? 0.0 : aside.norm());
    way += hop.offset.norm() + hop.slide;
    if (hop.joint < 0) continue;
    const TwistSize a = hop.slides ? TwistSize{1.0, 0.0} : TwistSize{lever, 1.0};
    const double rate = hop.share * hypotenuse(piece.x[hop.joint], piece.y[hop.joint]);
    const TwistSize changes = bracket(a, after);
    const TwistSize twice = bracket(changes, after) + bracket(a, after_changes);
    bends =
        bends + curvature * curvature * rate * a + 2.0 * curvature * rate * changes + rate * twice;
    after = after + rate * a;
    after_changes = after_changes + curvature * rate * a + rate * changes;
  }
  // What image_speed() makes of a twist of these sizes, in whatever direction: it is a norm, so
  // those of three axes bound it (Cauchy–Schwarz).
  const Vec3 none = Vec3::Zero();
  const auto square = [&](const CameraTwist& twist) {
    const double speed = image_speed(twist, limit_.camera, limit_.distance_m);
    return speed * speed;
  };
  double shift2 = 0.0;
  double turn2 = 0.0;
  for (const int axis : {0, 1, 2}) {
    shift2 += square({Vec3::Unit(axis), none});
    turn2 += square({none, Vec3::Unit(axis)});
  }
  return bends.linear * std::sqrt(shift2) + bends.angular * std::sqrt(turn2);
}

}  // namespace canopeer
