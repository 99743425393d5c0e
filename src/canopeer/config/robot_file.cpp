#include "canopeer/config/robot_file.h"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <string_view>

#include "canopeer/config/shapeless_links.h"
#include "canopeer/config/srdf.h"
#include "canopeer/config/urdf.h"
#include "canopeer/config/yaml_reader.h"
#include "canopeer/robot/arm_reach.h"

namespace canopeer {

Pose read_pose(YamlMap pose) {
  const std::vector<double> xyz = pose.numbers("xyz_m", {0.0, 0.0, 0.0}, 3);
  const std::vector<double> rpy = pose.numbers("rpy_deg", {0.0, 0.0, 0.0}, 3);
  const double degree = std::numbers::pi / 180.0;
  Pose T = Pose::Identity();
  T.translation() = Vec3(xyz[0], xyz[1], xyz[2]);
  T.linear() = (Eigen::AngleAxisd(rpy[2] * degree, Vec3::UnitZ()) *
                Eigen::AngleAxisd(rpy[1] * degree, Vec3::UnitY()) *
                Eigen::AngleAxisd(rpy[0] * degree, Vec3::UnitX()))
                   .toRotationMatrix();
  return T;
}

namespace {

Box read_box(YamlMap box) {
  Box result;
  int axis = 0;
  for (const char* key : {"x_m", "y_m", "z_m"}) {
    const std::vector<double> range = box.required_numbers(key, 2);
    if (box.has(key) && range[0] >= range[1])
      box.complain(key, "expected [low, high] with low < high");
    result.min()[axis] = range[0];
    result.max()[axis] = range[1];
    ++axis;
  }
  return result;
}

Configuration to_configuration(const std::vector<double>& values) {
  // Another count than that of the joints is refused by RobotModel::make.
  const int count = std::min(static_cast<int>(values.size()), kMaxArmJoints);
  return Eigen::Map<const Configuration>(values.data(), count);
}

struct RobotFile {
  std::filesystem::path urdf;
  std::filesystem::path srdf;  // empty: none
  std::vector<std::filesystem::path> package_path;
  bool visual_for_collision = false;
  RobotSetup setup;
  std::vector<double> arm_velocity_limits;  // empty: the URDF's
  std::vector<double> arm_acceleration_limits;
  double trolley_acceleration_limit = 0.0;
  std::vector<double> travel_limits;   // empty: the URDF's
  std::optional<Pose> T_frame_camera;  // the mounting, when the file says one
};

Expected<RobotFile> read_keys(const std::filesystem::path& path) {
  auto loaded = YamlMap::load(path);
  if (!loaded) return fail(loaded.error().message);
  YamlMap& yaml = *loaded;
  RobotFile file;
  RobotSetup& setup = file.setup;
  (void)yaml.text("name", "");
  file.urdf = yaml.directory() / yaml.required_text("urdf");
  if (yaml.has("srdf")) file.srdf = yaml.directory() / yaml.text("srdf", "");
  for (const std::string& folder : yaml.text_or_texts("package_path", {}))
    file.package_path.push_back(yaml.directory() / folder);
  file.visual_for_collision =
      yaml.choice("collision", "collision", {"collision", "visual"}) == "visual";
  setup.base_link = yaml.required_text("base_link");
  setup.camera_frame = yaml.required_text("camera_frame");
  if (!yaml.has("arm_joints")) (void)yaml.required_text("arm_joints");
  setup.arm_joints = yaml.texts("arm_joints", {});
  setup.travel_joint = yaml.text("travel_joint", "");
  setup.lift_joint = yaml.text("lift_joint", "");
  setup.T_world_root = read_pose(yaml.map("world_to_root"));
  if (yaml.has("camera_mounting")) file.T_frame_camera = read_pose(yaml.map("camera_mounting"));

  if (setup.arm_joints.size() > kMaxArmJoints)
    yaml.complain("arm_joints", "expected at most " + std::to_string(kMaxArmJoints) +
                                    " joints, found " + std::to_string(setup.arm_joints.size()));
  const std::size_t dof = setup.arm_joints.size();
  if (yaml.has("arm_velocity_limits_rad_s"))
    file.arm_velocity_limits = yaml.numbers("arm_velocity_limits_rad_s", {}, dof, {1e-4, 1e3});
  file.arm_acceleration_limits = yaml.numbers("arm_acceleration_limits_rad_s2",
                                              std::vector<double>(dof, 1.0), dof, {1e-3, 1e3});
  file.trolley_acceleration_limit =
      yaml.number("trolley_acceleration_limit_m_s2", 0.5, {1e-3, 1e3});

  if (yaml.has("travel_limits_m")) {
    file.travel_limits = yaml.required_numbers("travel_limits_m", 2);
    if (setup.travel_joint.empty()) yaml.complain("travel_limits_m", "needs a travel_joint");
    if (file.travel_limits[0] >= file.travel_limits[1]) {
      yaml.complain("travel_limits_m", "expected [low, high] with low < high");
    }
  }

  YamlMap homes = yaml.map("home_states_rad");
  for (const std::string& name : homes.keys())
    setup.home[name] = to_configuration(homes.required_numbers(name, dof));
  YamlMap standing = yaml.map("standing_joints_rad");
  for (const std::string& name : standing.keys())
    setup.standing[name] = standing.required_number(name);
  YamlMap poses = yaml.map("standing_poses");
  for (const std::string& name : poses.keys())
    setup.standing_poses[name] = read_pose(poses.required_map(name));
  if (yaml.has("known_free")) setup.known_free = read_box(yaml.map("known_free"));
  for (YamlMap& side : yaml.maps("sides")) {
    setup.workspace.push_back(read_box(side.required_map("workspace")));
    setup.sampling_region.push_back(read_box(side.required_map("sampling_region")));
  }
  if (auto done = yaml.finish(); !done) return fail(done.error().message);
  return file;
}

void set_arm_and_trolley_limits(const RobotFile& file, RobotDescription& robot) {
  for (Joint& joint : robot.joints) {
    const auto& arm = file.setup.arm_joints;
    const auto it = std::find(arm.begin(), arm.end(), joint.name);
    if (it != arm.end()) {
      joint.acceleration_limit = file.arm_acceleration_limits[it - arm.begin()];
      if (!file.arm_velocity_limits.empty())
        joint.velocity_limit = file.arm_velocity_limits[it - arm.begin()];
    } else if (joint.name == file.setup.travel_joint || joint.name == file.setup.lift_joint) {
      joint.acceleration_limit = file.trolley_acceleration_limit;
    }
  }
}

/// Rails of another length than the URDF's.
void set_travel_limits(const RobotFile& file, RobotDescription& robot) {
  if (file.travel_limits.empty()) return;
  for (Joint& joint : robot.joints) {
    if (joint.name != file.setup.travel_joint) continue;
    joint.lower = file.travel_limits[0];
    joint.upper = file.travel_limits[1];
    joint.flaw.clear();
  }
}

constexpr std::string_view kMounted = "_as_mounted";

/// Hangs a frame of the camera's own on the frame the URDF has for it.
void mount_camera(const Pose& T_frame_camera, RobotDescription& robot, RobotSetup& setup) {
  const std::string mounted = setup.camera_frame + std::string(kMounted);
  Joint joint;
  joint.name = mounted + "_joint";
  joint.parent = setup.camera_frame;
  joint.child = mounted;
  joint.T_parent_joint = T_frame_camera;
  robot.links.push_back({mounted, {}});
  robot.joints.push_back(joint);
  setup.camera_frame = mounted;
}

/// The map's distances are kept as far as the arm reaches: memory grows with the cube of that.
Expected<void> check_reach(const RobotModel& robot) {
  constexpr double kFarthest = 10.0;  // m
  const double reach = arm_reach_m(robot);
  if (reach <= kFarthest) return {};
  char text[192];
  std::snprintf(
      text, sizeof text,
      "the arm reaches up to %.4g m from '%s'; expected at most %.0f m: are its joints or "
      "meshes given in millimetres?",
      reach, robot.setup().base_link.c_str(), kFarthest);
  return fail(text);
}

bool has_link(const RobotDescription& robot, const std::string& name) {
  return std::any_of(robot.links.begin(), robot.links.end(),
                     [&](const Link& link) { return link.name == name; });
}

}  // namespace

Expected<std::filesystem::path> robot_urdf(const std::filesystem::path& path) {
  const auto file = read_keys(path);
  if (!file) return tl::unexpected(file.error());
  return file->urdf;
}

Expected<RobotModel> load_robot(const std::filesystem::path& path,
                                const std::optional<Pose>& T_frame_camera,
                                const std::vector<std::filesystem::path>& package_path) {
  auto file = read_keys(path);
  if (!file) return fail(file.error().message);
  file->package_path.insert(file->package_path.end(), package_path.begin(), package_path.end());
  auto robot = read_urdf(file->urdf, file->package_path, file->visual_for_collision);
  if (!robot) return fail(robot.error().message);
  if (file->srdf.empty()) {
    robot->neighbours_may_touch = true;
  } else if (auto read = read_srdf(file->srdf, *robot); !read) {
    return fail(read.error().message);
  }
  if (const std::string unchecked = links_without_shapes(*robot, file->setup.arm_joints);
      !unchecked.empty())
    robot->notices.push_back(unchecked);
  set_arm_and_trolley_limits(*file, *robot);
  set_travel_limits(*file, *robot);
  const auto mounting = T_frame_camera ? T_frame_camera : file->T_frame_camera;
  if (mounting && has_link(*robot, file->setup.camera_frame)) {
    mount_camera(*mounting, *robot, file->setup);
  }
  auto model = RobotModel::make(std::move(*robot), file->setup);
  if (!model) return fail_in(path.string(), model.error());
  if (auto reach = check_reach(*model); !reach) return fail_in(path.string(), reach.error());
  return model;
}

Pose camera_mounting(const RobotModel& robot) {
  const std::string& frame = robot.setup().camera_frame;
  for (const Joint& joint : robot.description().joints) {
    if (joint.child == frame && frame.ends_with(kMounted)) return joint.T_parent_joint;
  }
  return Pose::Identity();
}

}  // namespace canopeer
