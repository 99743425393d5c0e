#include "canopeer/geometry/triangle_mesh.h"

namespace canopeer {

void TriangleMesh::append(const TriangleMesh& other, const Pose& T_this_other) {
  const auto offset = static_cast<std::uint32_t>(vertices.size());
  const Eigen::Isometry3f T = T_this_other.cast<float>();
  for (const auto& v : other.vertices) vertices.push_back(T * v);
  for (const auto& n : other.normals) normals.push_back(T.linear() * n);
  for (const auto& t : other.triangles) {
    triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
}

Box TriangleMesh::bounds() const {
  Box box;
  for (const auto& v : vertices) box.extend(v.cast<double>());
  return box;
}

double TriangleMesh::volume() const {
  if (vertices.empty()) return 0.0;
  const Vec3 origin = vertices.front().cast<double>();
  double six_volumes = 0.0;
  for (const auto& t : triangles) {
    const Vec3 a = vertices[t[0]].cast<double>() - origin;
    const Vec3 b = vertices[t[1]].cast<double>() - origin;
    const Vec3 c = vertices[t[2]].cast<double>() - origin;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

double TriangleMesh::area() const {
  double twice = 0.0;
  for (const auto& t : triangles) {
    const Vec3 a = vertices[t[0]].cast<double>();
    const Vec3 b = vertices[t[1]].cast<double>();
    const Vec3 c = vertices[t[2]].cast<double>();
    twice += (b - a).cross(c - a).norm();
  }
  return twice / 2.0;
}

void compute_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f n = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                                  .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    for (const auto i : t) mesh.normals[i] += n;
  }
  for (auto& n : mesh.normals) {
    const float length = n.norm();
    n = length > 0.0F ? Eigen::Vector3f(n / length) : Eigen::Vector3f::UnitZ();
  }
}

TriangleMesh make_box(const Box& box) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(box.corner(static_cast<Box::CornerType>(i)).cast<float>());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

}  // namespace canopeer
