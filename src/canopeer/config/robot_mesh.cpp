#include "canopeer/config/robot_mesh.h"

#include <algorithm>

#include "canopeer/import/mesh_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code code;
  return fs::is_regular_file(path, code);
}

Expected<fs::path> find_in_package(const std::string& name, const std::string& rest,
                                   const MeshSearch& search) {
  const auto slash = rest.find('/');
  if (slash == std::string::npos || slash == 0)
    return fail("'" + name + "': expected package://PACKAGE/FILE");
  const fs::path package = rest.substr(0, slash);
  const fs::path file = rest.substr(slash + 1);
  std::vector<fs::path> folders = search.package_path;
  std::error_code code;
  // A file in the working directory has no directory in its name.
  const fs::path beside = search.directory.empty() ? fs::path(".") : search.directory;
  fs::path above = fs::absolute(beside, code).lexically_normal();
  if (!above.has_filename()) above = above.parent_path();
  for (; above.has_relative_path(); above = above.parent_path()) folders.push_back(above);
  std::string tried;
  for (const fs::path& folder : folders) {
    fs::path normal = folder.lexically_normal();
    if (!normal.has_filename()) normal = normal.parent_path();
    if (normal.filename() == package && is_file(folder / file)) return folder / file;
    if (is_file(folder / package / file)) return folder / package / file;
    tried += (tried.empty() ? "" : ", ") + folder.string();
  }
  return fail("mesh '" + name + "' not found; looked in " + tried +
              " (add the folder that holds '" + package.string() + "' to package_path)");
}

}  // namespace

Expected<fs::path> find_mesh(const std::string& name, const MeshSearch& search) {
  const auto scheme = name.find("://");
  const std::string rest = scheme == std::string::npos ? name : name.substr(scheme + 3);
  const std::string kind = scheme == std::string::npos ? "" : name.substr(0, scheme);
  if (kind == "package") return find_in_package(name, rest, search);
  if (!kind.empty() && kind != "file")
    return fail("mesh '" + name + "': expected package://, file:// or a path");
  const fs::path path = search.directory / rest;
  if (!is_file(path)) return fail("mesh '" + name + "' not found; looked for " + path.string());
  return path;
}

Expected<CollisionShape> load_mesh_shape(const std::string& name, const Vec3& scale,
                                         const Pose& T_link_mesh, const MeshSearch& search) {
  auto path = find_mesh(name, search);
  if (!path) return fail(path.error().message);
  MeshFileOptions options;
  options.honour_up_axis = false;
  TextureStore textures;
  auto file = read_mesh_file(*path, options, textures);
  if (!file) return fail(file.error().message);
  TriangleMesh all;
  for (const MeshPiece& piece : file->pieces) all.append(piece.mesh);
  all.normals.clear();
  if (all.triangles.empty()) return fail(path->string() + ": no triangles in it");
  if (!(scale.cwiseAbs().minCoeff() > 0.0)) return fail("the mesh's scale has a zero in it");
  for (auto& vertex : all.vertices) vertex = vertex.cwiseProduct(scale.cast<float>());
  if (scale.prod() < 0.0) {  // mirrored: what was outside must stay outside
    for (auto& triangle : all.triangles) std::swap(triangle[1], triangle[2]);
  }
  return CollisionShape::of_mesh(std::move(all), T_link_mesh, path->string());
}

}  // namespace canopeer
