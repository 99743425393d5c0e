#include "canopeer/robot/ik/closed_form_ik.h"

#include "canopeer/base/check.h"
#include "canopeer/geometry/angles.h"

namespace canopeer {
namespace {

constexpr double kOnAxis = 1e-7;    // metres or sine: the camera looks along the last axis
constexpr double kSame = 1e-9;      // configurations nearer to each other than this are one
constexpr int kSamplesOfALead = 9;  // positions of a rail, evenly spread over its length
constexpr int kMostLeadSamples = 81;

bool endless(const ArmGeometry& geometry, int joint) { return std::isinf(geometry.lower[joint]); }

/// Evenly spread positions of the joints before the closed form.
std::vector<Configuration> spread(const ArmGeometry& geometry, int leads) {
  std::vector<Configuration> samples;
  if (leads == 0) return samples;
  const int each = leads == 1
                       ? kSamplesOfALead
                       : std::max(2, static_cast<int>(std::pow(kMostLeadSamples, 1.0 / leads)));
  Eigen::VectorXi index = Eigen::VectorXi::Zero(leads);
  while (index[leads - 1] < each) {
    Configuration sample(leads);
    for (int i = 0; i < leads; ++i)
      sample[i] = endless(geometry, i)
                      ? 2.0 * kPi * index[i] / each
                      : geometry.lower[i] +
                            (geometry.upper[i] - geometry.lower[i]) * index[i] / (each - 1.0);
    samples.push_back(sample);
    for (int i = 0; i < leads; ++i) {
      if (++index[i] < each || i + 1 == leads) break;
      index[i] = 0;
    }
  }
  return samples;
}

ArmGeometry last_six(const ArmGeometry& geometry) {
  const int leads = static_cast<int>(geometry.axes.size()) - 6;
  ArmGeometry tail;
  tail.axes.assign(geometry.axes.begin() + leads, geometry.axes.end());
  tail.T_base_camera = geometry.T_base_camera;
  tail.lower = geometry.lower.tail(6);
  tail.upper = geometry.upper.tail(6);
  return tail;
}

double roll_sign(const ArmGeometry& geometry) {
  const RobotModel::AxisLine& last = geometry.axes.back();
  const Vec3 optical = geometry.T_base_camera.linear().col(2);
  const Vec3 aside = (geometry.T_base_camera.translation() - last.point).cross(last.direction);
  if (aside.norm() > kOnAxis || optical.cross(last.direction).norm() > kOnAxis) return 0.0;
  return optical.dot(last.direction) > 0.0 ? 1.0 : -1.0;
}

}  // namespace

Expected<std::unique_ptr<IkSolver>> ClosedFormIk::make(const ArmGeometry& geometry) {
  const int leads = static_cast<int>(geometry.axes.size()) - 6;
  if (leads < 0) return fail("it has fewer than six joints");
  const ArmGeometry tail = last_six(geometry);
  for (const auto& axis : tail.axes) {
    if (axis.type != JointType::kRevolute) return fail("one of its last six joints is a slide");
  }
  auto form = make_ur_form(tail);
  if (!form) {
    const std::string not_ur = form.error().message;
    form = make_spherical_wrist_form(tail);
    if (!form)
      return fail("not built like a UR: " + not_ur +
                  "; no spherical wrist: " + form.error().message);
  }
  std::unique_ptr<ClosedFormIk> ik(new ClosedFormIk);
  ik->form_ = std::move(*form);
  ik->geometry_ = geometry;
  ik->leads_ = leads;
  ik->lead_samples_ = spread(geometry, leads);
  ik->roll_sign_ = roll_sign(geometry);
  return ik;
}

/// Brings the first `joints` of the six near the reference; false: one is outside its limits.
bool ClosedFormIk::fit(const SixAngles& angles, int joints, const Configuration& reference,
                       Configuration& q) const {
  for (int i = 0; i < joints; ++i) {
    const int joint = leads_ + i;
    double angle = angles[static_cast<std::size_t>(i)];
    if (!bring_near(angle, reference[joint], geometry_.lower[joint], geometry_.upper[joint]))
      return false;
    q[joint] = angle;
  }
  return true;
}

void ClosedFormIk::solve_tail(const Pose& T_tail_camera, const Configuration& reference,
                              std::vector<Configuration>& out) const {
  std::array<SixAngles, SixJointForm::kMaxBranches> found;
  const std::size_t first = out.size();
  const int count = form_->branches(T_tail_camera, reference[leads_ + 5], found);
  Configuration q = reference;
  for (int k = 0; k < count; ++k) {
    if (!fit(found[static_cast<std::size_t>(k)], 6, reference, q)) continue;
    bool known = false;
    for (std::size_t i = first; i < out.size() && !known; ++i)
      known = (out[i] - q).lpNorm<Eigen::Infinity>() < kSame;
    if (!known) out.push_back(q);
  }
}

// The camera looks along the last axis: one solution serves all rolls.
void ClosedFormIk::solve_rolls(const Pose& T_tail_camera, const Configuration& reference, int rolls,
                               std::vector<Configuration>& out) const {
  std::array<SixAngles, SixJointForm::kMaxBranches> found;
  const int last = leads_ + 5;
  const int count = form_->branches(T_tail_camera, reference[last], found);
  Configuration q = reference;
  for (int k = 0; k < count; ++k) {
    const SixAngles& angles = found[static_cast<std::size_t>(k)];
    if (!fit(angles, 5, reference, q)) continue;
    for (int roll = 0; roll < rolls; ++roll) {
      q[last] = angles[5] + roll_sign_ * 2.0 * kPi * roll / rolls;
      if (bring_near(q[last], reference[last], geometry_.lower[last], geometry_.upper[last]))
        out.push_back(q);
    }
  }
}

/// `solve(T_base_tail, reference with that lead)` at the reference's own lead, then at each sample.
template <typename Solve>
void ClosedFormIk::for_each_lead(const Configuration& reference, Solve&& solve) const {
  Configuration near = reference;
  for (std::size_t k = 0; k == 0 || k <= lead_samples_.size(); ++k) {
    if (k > 0) near.head(leads_) = lead_samples_[k - 1];
    for (int i = 0; i < leads_; ++i) {
      if (k > 0 && endless(geometry_, i))
        bring_near(near[i], reference[i], geometry_.lower[i], geometry_.upper[i]);
    }
    Pose T_base_tail = Pose::Identity();
    for (int i = 0; i < leads_; ++i)
      T_base_tail =
          T_base_tail * joint_motion(geometry_.axes[static_cast<std::size_t>(i)], near[i]);
    solve(T_base_tail, near);
  }
}

void ClosedFormIk::solve(const Pose& T_base_camera, const Configuration& reference,
                         std::vector<Configuration>& out) const {
  for_each_lead(reference, [&](const Pose& T_base_tail, const Configuration& near) {
    solve_tail(T_base_tail.inverse() * T_base_camera, near, out);
  });
}

void ClosedFormIk::solve_view(const Vec3& position, const Vec3& target,
                              const Configuration& reference, std::vector<Configuration>& out,
                              const ViewIkOptions& options) const {
  out.clear();
  const Pose upright = look_at(position, target);
  for_each_lead(reference, [&](const Pose& T_base_tail, const Configuration& near) {
    const Pose T_tail_camera = T_base_tail.inverse() * upright;
    if (roll_sign_ != 0.0) {
      solve_rolls(T_tail_camera, near, options.rolls, out);
      return;
    }
    for (int k = 0; k < options.rolls; ++k)
      solve_tail(T_tail_camera * Eigen::AngleAxisd(2.0 * kPi * k / options.rolls, Vec3::UnitZ()),
                 near, out);
  });
}

}  // namespace canopeer
