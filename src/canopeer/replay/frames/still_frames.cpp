#include "canopeer/replay/frames/still_frames.h"

#include <bit>
#include <map>
#include <tuple>

#include "canopeer/base/byte_order.h"
#include "canopeer/replay/frames/frame_head.h"

namespace canopeer::frames {
namespace {

/// Vertices and triangles of many meshes, one after the other.
struct Triangles {
  std::string vertices;
  std::string corners;
  std::uint32_t vertex_count = 0;
  std::uint32_t triangle_count = 0;

  void add_vertex(const Eigen::Vector3f& v) {
    for (int i = 0; i < 3; ++i) append_number(vertices, v[i]);
    ++vertex_count;
  }
  void add_triangle(const std::array<std::uint32_t, 3>& triangle, std::uint32_t first_vertex) {
    for (const std::uint32_t corner : triangle) append_number(corners, corner + first_vertex);
    ++triangle_count;
  }
};

Json shape_json(const CollisionShape& shape, Triangles& all) {
  Json json;
  switch (shape.kind) {
    case ShapeKind::kBox:
      json = {{"kind", "box"}, {"size", from(shape.size_m)}};
      break;
    case ShapeKind::kCylinder:
      json = {{"kind", "cylinder"},
              {"radius", rounded(shape.size_m.x(), 1e-4)},
              {"length", rounded(shape.size_m.z(), 1e-4)}};
      break;
    case ShapeKind::kSphere:
      json = {{"kind", "sphere"}, {"radius", rounded(shape.size_m.x(), 1e-4)}};
      break;
    case ShapeKind::kMesh: {
      const TriangleMesh& mesh = shape.mesh->triangles;
      json = {{"kind", "mesh"},
              {"vertex", all.vertex_count},
              {"vertices", mesh.vertices.size()},
              {"triangle", all.triangle_count},
              {"triangles", mesh.triangles.size()}};
      for (const auto& v : mesh.vertices) all.add_vertex(v);
      for (const auto& t : mesh.triangles) all.add_triangle(t, 0);
      break;
    }
  }
  json["pose"] = from(shape.T_link_shape);
  return json;
}

Json link_json(const RobotModel& robot, int index, Triangles& all) {
  using Driver = RobotModel::Mount::Driver;
  const Link& link = robot.links()[static_cast<std::size_t>(index)];
  const RobotModel::Mount mount = robot.mount(index);
  constexpr const char* kDrivers[] = {"still", "arm", "travel", "lift"};
  Json json = {{"name", link.name},
               {"parent", mount.parent},
               {"type", mount.type == JointType::kRevolute    ? "revolute"
                        : mount.type == JointType::kPrismatic ? "prismatic"
                                                              : "fixed"},
               {"origin", from(mount.T_parent_joint)},
               {"source", kDrivers[static_cast<int>(mount.driver)]}};
  if (mount.driver != Driver::none) {
    json["axis"] = Json::array({mount.axis.x(), mount.axis.y(), mount.axis.z()});
    json["multiplier"] = mount.multiplier;
    json["offset"] = mount.offset;
  }
  if (mount.driver == Driver::arm) json["index"] = mount.arm_joint;
  json["shapes"] = Json::array();
  for (const CollisionShape& shape : link.visual.empty() ? link.collision : link.visual)
    json["shapes"].push_back(shape_json(shape, all));
  return json;
}

/// Keeps the twelve highest bits of the fraction: what is left compresses well.
float coarse(float value) {
  constexpr std::uint32_t kLow = (1U << 11) - 1;
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(value) + kLow / 2) & ~kLow);
}

const char* what_it_is(PartClass kind) {
  switch (kind) {
    case PartClass::leaf:
      return "leaf";
    case PartClass::stem:
    case PartClass::calyx:
      return "stem";
    case PartClass::fruit:
      return "fruit";
    case PartClass::structure:
      return "structure";
    case PartClass::distractor:
    case PartClass::support:
      break;
  }
  return "other";
}

}  // namespace

Frame robot_frame(const RobotModel& robot, const CameraIntrinsics& camera) {
  Triangles all;
  Json head = head_of("robot");
  head["links"] = Json::array();
  for (int i = 0; i < static_cast<int>(robot.links().size()); ++i)
    head["links"].push_back(link_json(robot, i, all));
  head["T_world_root"] = from(robot.setup().T_world_root);
  head["camera_link"] = robot.link_index(robot.setup().camera_frame);
  head["camera"] = from(camera);
  head["vertices"] = all.vertex_count;
  return frame_of(head, all.vertices + all.corners);
}

Frame truth_frame(const Scene& scene) {
  // Parts of one kind and colour together: a page draws each group at once.
  using Group = std::tuple<std::string, int, int, int>;
  struct Piece {
    const ScenePart* part;
    Pose T;
  };
  std::map<Group, std::vector<Piece>> groups;
  scene.for_each_part([&](const ScenePart& part, const Pose& T, const SceneInstance*) {
    groups[{what_it_is(part.kind), part.color.r, part.color.g, part.color.b}].push_back({&part, T});
  });
  Triangles all;
  Json head = head_of("truth");
  head["vertices"] = 0;
  head["parts"] = Json::array();
  for (const auto& [group, pieces] : groups) {
    const std::uint32_t first = all.triangle_count;
    for (const Piece& piece : pieces) {
      const std::uint32_t first_vertex = all.vertex_count;
      const Eigen::Isometry3f T = piece.T.cast<float>();
      for (const auto& v : piece.part->mesh.vertices) all.add_vertex((T * v).unaryExpr(&coarse));
      for (const auto& t : piece.part->mesh.triangles) all.add_triangle(t, first_vertex);
    }
    const auto& [what, r, g, b] = group;
    head["parts"].push_back({{"what", what},
                             {"color", {r, g, b}},
                             {"triangle", first},
                             {"triangles", all.triangle_count - first}});
  }
  head["vertices"] = all.vertex_count;
  head["fruits"] = Json::array();
  for (const FruitTruth& fruit : scene.fruits) {
    head["fruits"].push_back({{"id", fruit.id},
                              {"centre", from(fruit.centre)},
                              {"radius", rounded(fruit.diameter_m / 2.0, 1e-4)},
                              {"counted", fruit.counted}});
  }
  return frame_of(head, all.vertices + all.corners);
}

}  // namespace canopeer::frames
