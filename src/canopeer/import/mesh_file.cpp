#include "canopeer/import/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "canopeer/base/atomic_file.h"
#include "canopeer/import/meshes/collada_asset.h"
#include "canopeer/import/meshes/file_kind.h"
#include "canopeer/import/meshes/file_mesh.h"
#include "canopeer/import/meshes/guarded_call.h"
#include "canopeer/import/meshes/material_painter.h"
#include "canopeer/import/meshes/mesh_library.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// Turns what is up in the file to z; what is to the right of a viewer stays at the right.
Eigen::Affine3d upright(UpAxis up) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (up == UpAxis::y) R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == UpAxis::x) R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return Eigen::Affine3d(R);
}

Expected<RootFrame> root_frame(const fs::path& path, const MeshFileOptions& options) {
  RootFrame frame;
  const std::string ending = ending_of(path);
  if (ending == ".gltf" || ending == ".glb") frame.T_upright_root = upright(UpAxis::y);
  if (ending != ".dae") return frame;
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto asset = parse_collada_asset(*text, path.string());
  if (!asset) return tl::unexpected(asset.error());
  frame.unit_m = asset->unit_m;
  if (options.honour_up_axis) frame.T_upright_root = upright(asset->up);
  return frame;
}

MaterialDialect dialect_of(const fs::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".dae") return MaterialDialect::collada;
  if (ending == ".gltf" || ending == ".glb") return MaterialDialect::gltf;
  return MaterialDialect::plain;
}

/// Sound files of today's computers take some seconds for each 100 MB; ten times that is hanging.
CallLimits limits_for(const fs::path& path, const MeshFileOptions& options) {
  std::error_code code;
  const auto bytes = fs::file_size(path, code);
  const std::size_t known = code ? 0 : static_cast<std::size_t>(bytes);
  return {options.least_cpu_s + static_cast<double>(known) * 2e-6,
          options.least_memory_bytes + 64 * known};
}

/// The file in a child process: the library ends or hangs that over some damaged files.
Expected<FileMesh> read_guarded(const fs::path& path, const MeshFileOptions& options) {
  const auto frame = root_frame(path, options);
  if (!frame) return tl::unexpected(frame.error());
  const auto bytes =
      guarded_call([&] { return encode(read_with_library(path, *frame, dialect_of(path))); },
                   limits_for(path, options));
  if (!bytes) {
    return fail(path.string() + ": cannot be read: " + bytes.error().message);
  }
  return decode_file_mesh(*bytes);
}

/// A file's first bytes, by which its kind is told.
std::string head_of(const fs::path& path) {
  std::string head(kFileHeadBytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return head;
}

/// What the file's name promises is what is in it.
Expected<void> check_kind(const fs::path& path) {
  const std::string head = head_of(path);
  if (const auto foreign = foreign_file(head)) return fail(path.string() + ": " + *foreign);
  if (!is_mesh_file(path)) {
    return fail(path.string() + ": expected a mesh, .dae, .obj, .stl, .gltf, .glb or .ply");
  }
  const std::string_view held = mesh_ending_by_content(head);
  const std::string ending = ending_of(path);
  if (held.empty() || held == ending || (held == ".glb" && ending == ".gltf")) return {};
  return fail(path.string() + ": holds what belongs into a " + std::string(held) +
              " file; give it that ending");
}

}  // namespace

bool is_mesh_file(const fs::path& path) {
  constexpr std::array kEndings = {".dae", ".obj", ".stl", ".gltf", ".glb", ".ply"};
  return std::find(kEndings.begin(), kEndings.end(), ending_of(path)) != kEndings.end();
}

Expected<MeshFile> read_mesh_file(const fs::path& path, const MeshFileOptions& options,
                                  TextureStore& textures) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return fail(path.string() + ": no such mesh file");
  if (auto ok = check_kind(path); !ok) return tl::unexpected(ok.error());
  auto mesh = read_guarded(path, options);
  if (!mesh) return tl::unexpected(mesh.error());
  if (mesh->parts.empty())
    return fail(
        path.string() +
        ": holds no triangles that can be read: nothing, points, lines, or faces of corners that "
        "are not there");
  MeshFile file;
  for (const std::string& notice : mesh->notices)
    file.notices.push_back(path.string() + ": " + notice);
  MaterialPainter painter(*mesh, path, textures, &file.notices);
  for (FileMesh::Part& part : mesh->parts) {
    part.piece.names.file = path.filename().string();
    painter.paint(part.material, &part.piece);
    file.pieces.push_back(std::move(part.piece));
    file.groups.push_back(part.group.empty() ? path.stem().string() : std::move(part.group));
  }
  return file;
}

}  // namespace canopeer
