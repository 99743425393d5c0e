#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>

#include "canopeer/base/atomic_file.h"
#include "canopeer/config/robot_file.h"
#include "canopeer/render/overview.h"
#include "canopeer/robot/collision_checker.h"
#include "canopeer/robot/exact_checker.h"
#include "canopeer/robot/robot_survey.h"
#include "canopeer/sensing/png.h"
#include "commands.h"
#include "exit_status.h"
#include "robot_picture.h"
#include "robot_source.h"

namespace canopeer::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeed = 1;

/// Counts what is wrong while it is printed.
class Findings {
 public:
  void wrong(const std::string& what) {
    ++count_;
    std::printf("  wrong: %s\n", what.c_str());
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  int count_ = 0;
};

void print_joints(const RobotModel& robot, const ArmIk& ik) {
  std::printf("robot %s: %zu links, %d arm joints, inverse kinematics %s",
              robot.description().name.c_str(), robot.links().size(), robot.dof(),
              std::string(ik_kind_name(ik.kind())).c_str());
  if (ik.sampled_joints() > 0) std::printf(", first %d joints sampled", ik.sampled_joints());
  std::printf("\n");
  for (const std::string& notice : robot.description().notices)
    std::printf("  notice: %s\n", notice.c_str());
  for (int i = 0; i < robot.dof(); ++i) {
    const bool slide = robot.arm_joint_type(i) == JointType::kPrismatic;
    const char* const unit = slide ? "m" : "rad";
    std::printf("  %-24s ", robot.setup().arm_joints[static_cast<std::size_t>(i)].c_str());
    if (robot.endless()[i]) {
      std::printf("turns without end");
    } else {
      std::printf("%8.3f … %7.3f %s", robot.limits().lower[i], robot.limits().upper[i], unit);
    }
    std::printf(", %.2f %s/s, %.2f %s/s²\n", robot.limits().velocity[i], unit,
                robot.limits().acceleration[i], unit);
  }
}

/// What stands for the links in collision checks.
void print_shapes(const RobotModel& robot) {
  std::map<ShapeKind, int> counts;
  std::size_t shapes = 0;
  std::size_t triangles = 0;
  for (const Link& link : robot.links()) {
    for (const CollisionShape& shape : link.collision) {
      ++shapes;
      ++counts[shape.kind];
      if (shape.mesh != nullptr) triangles += shape.mesh->triangles.triangles.size();
    }
  }
  std::printf(
      "collision shapes: %zu (%d boxes, %d cylinders, %d spheres, %d meshes), %zu triangles\n",
      shapes, counts[ShapeKind::kBox], counts[ShapeKind::kCylinder], counts[ShapeKind::kSphere],
      counts[ShapeKind::kMesh], triangles);
}

/// Whether the camera's axis meets the sampling region of the side the home state is for: the first
/// frame of a segment is taken there.
void check_first_look(const RobotModel& robot, Findings& findings) {
  constexpr double kFar = 2.0;  // m
  for (int side = 1; side <= robot.sides(); ++side) {
    const std::string name = "side_" + std::to_string(side);
    if (!robot.has_home(name)) continue;
    const Pose T_base_camera = robot.T_base_camera(robot.home(name));
    bool meets = false;
    for (double depth = 0.0; depth < kFar && !meets; depth += 0.01)
      meets = robot.sampling_region(side).contains(T_base_camera * Vec3(0.0, 0.0, depth));
    if (meets) {
      std::printf("  %s: the camera looks into its sampling region\n", name.c_str());
    } else {
      findings.wrong("home state '" + name + "': the z axis of '" + robot.setup().camera_frame +
                     "' does not meet the sampling region; is it the optical frame (z forward, y " +
                     "down), and does the arm face this side?");
    }
  }
}

bool has_arm_shapes(const RobotModel& robot) {
  const auto& moving = robot.moving_links();
  return std::any_of(moving.begin(), moving.end(), [&](int link) {
    return !robot.links()[static_cast<std::size_t>(link)].collision.empty();
  });
}

void check_homes(const RobotModel& robot, Findings& findings) {
  std::printf("home states\n");
  const char* const free = has_arm_shapes(robot) ? "free" : "nothing to check";
  const ExactChecker exact(robot);
  for (int side = 1; side <= robot.sides(); ++side) {
    const std::string name = "side_" + std::to_string(side);
    if (!robot.has_home(name)) findings.wrong("missions need a home state '" + name + "'");
  }
  for (const auto& [name, q] : robot.setup().home) {
    std::vector<double> lifts = {robot.lift_axis().lower};
    if (robot.lift_axis().upper > lifts[0]) lifts.push_back(robot.lift_axis().upper);
    for (const double lift : lifts) {
      const TrolleyState trolley{robot.travel_axis().lower, lift};
      const ContactReport contacts = exact.check(q, trolley);
      char where[64];
      std::snprintf(where, sizeof where, " at lift %.2f m", lift);
      if (contacts.any()) {
        findings.wrong("home state '" + name + "'" + where + ": " + contacts.pair + " touch");
      } else if (!CollisionChecker(robot, trolley).state_free(q)) {
        findings.wrong("home state '" + name + "'" + where +
                       " is free, but nearer to contact than the planner allows");
      } else {
        std::printf("  %s%s: %s\n", name.c_str(), where, free);
      }
    }
  }
}

/// Missions in which unknown space blocks rely on this box.
void check_known_free(const RobotModel& robot, Findings& findings) {
  const Box& box = robot.setup().known_free;
  if (box.isEmpty()) {
    std::printf("known_free: none, so no missions with 'collision.unknown: blocked'\n");
    return;
  }
  std::printf("known_free\n");
  constexpr double kSpare = 0.02;  // the padding, and a voxel
  for (const auto& [name, q] : robot.setup().home) {
    const Box arm = arm_bounds(robot, q);
    const Box needed(arm.min() - Vec3::Constant(kSpare), arm.max() + Vec3::Constant(kSpare));
    if (box.contains(needed)) {
      std::printf("  %s: inside\n", name.c_str());
      continue;
    }
    char room[160];
    std::snprintf(room, sizeof room, "x %.2f ... %.2f, y %.2f ... %.2f, z %.2f ... %.2f",
                  needed.min().x(), needed.max().x(), needed.min().y(), needed.max().y(),
                  needed.min().z(), needed.max().z());
    findings.wrong("home state '" + name + "' sticks out of known_free, so that it is blocked " +
                   "with 'collision.unknown: blocked'; the arm there needs " + room);
  }
}

/// The robot as it would be with suggested.srdf.
std::optional<RobotModel> with_suggested_pairs(const RobotModel& robot,
                                               const std::vector<LinkPairSurvey>& pairs) {
  RobotDescription description = robot.description();
  bool more = false;
  for (const LinkPairSurvey& pair : pairs) {
    if (pair.disabled || pair.reason_to_disable() == nullptr) continue;
    description.disabled_pairs.emplace_back(pair.link_a, pair.link_b);
    more = true;
  }
  if (!more) return std::nullopt;
  auto model = RobotModel::make(std::move(description), robot.setup());
  if (!model) return std::nullopt;
  return std::move(*model);
}

void check_reach(const RobotModel& robot, const ArmIk& ik, int views,
                 const std::vector<LinkPairSurvey>& pairs, Findings& findings) {
  const std::optional<RobotModel> suggested = with_suggested_pairs(robot, pairs);
  std::printf("reach (%d random views a side, target in the sampling region 0.3-0.6 m away)\n",
              views);
  if (robot.sides() == 0) findings.wrong("no sides: a mission needs workspace and sampling region");
  for (int side = 1; side <= robot.sides(); ++side) {
    const ReachSurvey survey = survey_reach(robot, ik, side, views, kSeed);
    if (survey.views == 0) {
      findings.wrong("side " + std::to_string(side) +
                     ": no place in the workspace is 0.3-0.6 m from the sampling region");
      continue;
    }
    std::printf("  side %d: %.1f %% reached, %.1f %% without touching itself or the trolley%s\n",
                side, 100.0 * survey.reached / survey.views, 100.0 * survey.free / survey.views,
                has_arm_shapes(robot) ? "" : ", which is not checked");
    const ReachSurvey then =
        suggested ? survey_reach(*suggested, ik, side, views, kSeed) : ReachSurvey();
    if (then.free > survey.free)
      std::printf("    with suggested.srdf: %.1f %% without touching\n",
                  100.0 * then.free / then.views);
    if (survey.free == 0 && then.free > 0) {
      findings.wrong("side " + std::to_string(side) +
                     ": no view of it can be taken without an SRDF such as suggested.srdf");
      continue;
    }
    if (survey.free == 0) {
      findings.wrong("side " + std::to_string(side) +
                     ": no view of it can be taken; its boxes are given in '" +
                     robot.setup().base_link + "': are they within the arm's reach, and is '" +
                     robot.setup().camera_frame + "' an optical frame (z forward, y down)?");
      continue;
    }
    const Box& box = robot.workspace(side);
    int empty = 0;
    for (std::size_t part = 0; part < survey.part_views.size(); ++part) {
      if (survey.part_views[part] == 0 || survey.part_free[part] > 0) continue;
      ++empty;
      const Vec3 index(static_cast<double>(part % 3), static_cast<double>(part / 3 % 3),
                       static_cast<double>(part / 9));
      const Vec3 low = box.min() + index.cwiseProduct(box.sizes()) / 3.0;
      const Vec3 high = low + box.sizes() / 3.0;
      std::printf("    not one view from x %.2f … %.2f, y %.2f … %.2f, z %.2f … %.2f\n", low.x(),
                  high.x(), low.y(), high.y(), low.z(), high.z());
    }
    if (empty > 0) std::printf("    %d of 27 parts of the workspace are of no use\n", empty);
  }
}

std::string share_of(int part, int whole) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100.0 * part / std::max(1, whole));
  return text;
}

std::vector<LinkPairSurvey> check_pairs(const RobotModel& robot, int states, Findings& findings) {
  constexpr double kOften = 0.3;
  constexpr int kNeverShown = 20;
  const auto pairs = survey_link_pairs(robot, states, kSeed);
  int checked = 0;
  for (const LinkPairSurvey& pair : pairs) checked += pair.disabled ? 0 : 1;
  std::printf("link pairs (%d random states): %zu, of which %d are checked\n", states, pairs.size(),
              checked);
  if (robot.description().neighbours_may_touch)
    std::printf("  no srdf: pairs that a joint connects are left out\n");
  int never = 0;
  for (const LinkPairSurvey& pair : pairs) {
    const std::string names = pair.link_a + " / " + pair.link_b;
    if (!pair.disabled && pair.adjacent && !pair.never())
      findings.wrong(names + " are joined by a joint and touch: disable the pair in the SRDF");
    else if (!pair.disabled && pair.always())
      findings.wrong(names + " always touch: disable the pair in the SRDF, or mend a shape");
    else if (pair.solids_always_touch)
      findings.wrong(names + " are never called free, though they touch in " +
                     share_of(pair.touching, pair.states) +
                     " of the states: hollows of meshes are filled up in fast checks; split the "
                     "mesh into convex parts, or disable the pair in the SRDF");
    else if (!pair.disabled && pair.touching > kOften * pair.states)
      std::printf("  touch in %.1f %% of the states, are their shapes too large? %s\n",
                  100.0 * pair.touching / pair.states, names.c_str());
    else if (!pair.disabled && pair.never() && ++never <= kNeverShown)
      std::printf("  never touch, could be disabled: %s\n", names.c_str());
    else if (pair.disabled && !pair.adjacent && !pair.never() && !pair.always())
      std::printf("  disabled, though they touch in %.1f %% of the states: %s\n",
                  100.0 * pair.touching / pair.states, names.c_str());
  }
  if (never > kNeverShown)
    std::printf("  never touch, could be disabled: %d more pairs\n", never - kNeverShown);
  return pairs;
}

void print_covers(const RobotModel& robot) {
  std::printf("spheres for collision checks\n");
  for (const CoverSurvey& cover : survey_covers(robot, CollisionOptions().sphere_excess_m))
    std::printf("  %-24s %3d spheres, volume +%.0f %%, sticking out by up to %.1f mm\n",
                cover.link.c_str(), cover.spheres, 100.0 * cover.quality.overhead(),
                1e3 * cover.quality.excess_m);
}

}  // namespace

/// Reads a robot, says what it is, what is wrong with it and where, and writes pictures and an
/// SRDF.
void robot_check(const RobotCheckArguments& arguments) {
  const RobotModel robot =
      value_or_stop(load_robot(arguments.robot, {}, ros_package_path()), kBadInput);
  const ArmIk ik = value_or_stop(ArmIk::make(robot), kBadInput);
  Findings findings;
  print_joints(robot, ik);
  print_shapes(robot);
  if (!has_arm_shapes(robot))
    findings.wrong("nothing of the arm can be checked for contact: no link of it has a shape");
  const int before_pairs = findings.count();
  // First, because pairs that always touch spoil all that follows.
  const auto pairs = check_pairs(robot, arguments.states, findings);
  if (findings.count() > before_pairs)
    std::printf(
        "  suggested.srdf disables what always or never touches: put it beside the robot "
        "file and name it there as srdf\n");
  check_homes(robot, findings);
  check_first_look(robot, findings);
  check_known_free(robot, findings);
  check_reach(robot, ik, arguments.views, pairs, findings);
  print_covers(robot);

  const fs::path out = arguments.out.empty() ? fs::path("out") / "robot" : fs::path(arguments.out);
  std::error_code code;
  fs::create_directories(out, code);
  if (code) stop_with(kFailed, {out.string() + ": cannot make the directory: " + code.message()});
  const Configuration q = robot.setup().home.empty()
                              ? Configuration((robot.span().lower + robot.span().upper) / 2.0)
                              : robot.setup().home.begin()->second;
  for (const bool spheres : {false, true})
    value_or_stop(write_png(out / (spheres ? "spheres.png" : "robot.png"),
                            render_overview(robot_scene(robot, q, 1, spheres), 1280, 960)),
                  kFailed);
  value_or_stop(write_file(out / "suggested.srdf", srdf_of(robot.description().name, pairs)),
                kFailed);
  std::printf(
      "wrote %s, %s (green: workspace of side 1, yellow: its sampling region, red: where "
      "the camera looks), %s\n",
      (out / "robot.png").c_str(), (out / "spheres.png").c_str(), (out / "suggested.srdf").c_str());
  if (findings.count() > 0)
    stop_with(kFailed, {std::to_string(findings.count()) + " thing(s) wrong with this robot"});
}

}  // namespace canopeer::app
