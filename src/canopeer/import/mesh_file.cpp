#include "canopeer/import/mesh_file.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <optional>

#include "canopeer/base/atomic_file.h"
#include "canopeer/import/collada_asset.h"
#include "canopeer/import/material_reader.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Eigen::Affine3d to_affine(const aiMatrix4x4& m) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  T.matrix().topRows<3>() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  return T;
}

/// Turns what is up in the file to z; what is to the right of a viewer stays at the right.
Eigen::Affine3d upright(UpAxis up) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (up == UpAxis::y) R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == UpAxis::x) R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return Eigen::Affine3d(R);
}

/// From the file's root node to metres with z up.
struct RootFrame {
  Eigen::Affine3d T_upright_root = Eigen::Affine3d::Identity();
  /// Assimp multiplies the unit from the right, where a translation of the root does not feel it;
  /// so it is taken off there and put on from the left.
  double unit_m = 1.0;

  [[nodiscard]] Eigen::Affine3d of(const aiNode& root) const {
    return T_upright_root * Eigen::Scaling(unit_m) * to_affine(root.mTransformation) *
           Eigen::Scaling(1.0 / unit_m);
  }
};

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

Rgb to_rgb(const aiColor4D& c) {
  const auto level = [](float x) {
    return static_cast<std::uint8_t>(std::clamp(x >= 0.0F ? x : 0.0F, 0.0F, 1.0F) * 255.0F + 0.5F);
  };
  return {level(c.r), level(c.g), level(c.b)};
}

/// Damaged files make faces without corners and meshes that are wrong about what faces they have;
/// the library's triangulation ends the process over either, so both are put right before it.
void repair_faces(aiMesh& mesh) {
  unsigned kept = 0;
  mesh.mPrimitiveTypes = 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const unsigned corners = mesh.mFaces[i].mNumIndices;
    if (corners == 0) continue;
    mesh.mPrimitiveTypes |= corners == 1   ? aiPrimitiveType_POINT
                            : corners == 2 ? aiPrimitiveType_LINE
                            : corners == 3 ? aiPrimitiveType_TRIANGLE
                                           : aiPrimitiveType_POLYGON;
    if (kept != i) mesh.mFaces[kept] = mesh.mFaces[i];
    ++kept;
  }
  mesh.mNumFaces = kept;
}

/// The file's scene, all of it triangles; nullptr when the library cannot read it.
const aiScene* read_triangles(Assimp::Importer& importer, const fs::path& path) {
  if (importer.ReadFile(path.string(), aiProcess_ValidateDataStructure) == nullptr) return nullptr;
  const aiScene* const scene = importer.GetScene();
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) repair_faces(*scene->mMeshes[i]);
  return importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
}

/// One assimp mesh in its own frame. Faces that are no triangles or point outside are left out.
MeshPiece to_piece(const aiMesh& from) {
  MeshPiece piece;
  piece.names.mesh = from.mName.C_Str();
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    const aiVector3D& p = from.mVertices[i];
    piece.mesh.vertices.emplace_back(p.x, p.y, p.z);
    if (from.HasNormals()) {
      const Eigen::Vector3f n(from.mNormals[i].x, from.mNormals[i].y, from.mNormals[i].z);
      const float length = n.norm();
      piece.mesh.normals.push_back(length > 0.0F && std::isfinite(length)
                                       ? Eigen::Vector3f(n / length)
                                       : Eigen::Vector3f(Eigen::Vector3f::UnitZ()));
    }
    if (from.HasTextureCoords(0)) {
      piece.uv.emplace_back(from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y);
    }
    if (from.HasVertexColors(0)) piece.vertex_colors.push_back(to_rgb(from.mColors[0][i]));
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) continue;
    const std::array<std::uint32_t, 3> t = {face.mIndices[0], face.mIndices[1], face.mIndices[2]};
    const bool good = std::all_of(t.begin(), t.end(), [&](std::uint32_t k) {
      return k < from.mNumVertices && piece.mesh.vertices[k].allFinite();
    });
    if (good) piece.mesh.triangles.push_back(t);
  }
  return piece;
}

/// Walks the nodes and gathers their meshes, in metres and upright.
class Gatherer {
 public:
  Gatherer(const aiScene& scene, const fs::path& path, MaterialReader& materials, MeshFile* file)
      : scene_(scene), path_(path), materials_(materials), file_(file) {}

  void walk(const aiNode& node, const Eigen::Affine3d& T_world_node, const std::string& group) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) continue;
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      MeshPiece piece = placed(without_copies(to_piece(mesh)), T_world_node);
      if (piece.mesh.triangles.empty()) continue;
      piece.names.node = node.mName.C_Str();
      piece.names.file = path_.filename().string();
      materials_.paint(mesh.mMaterialIndex, &piece);
      file_->pieces.push_back(std::move(piece));
      file_->groups.push_back(group.empty() ? path_.stem().string() : group);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      const aiNode& child = *node.mChildren[i];
      walk(child, T_world_node * to_affine(child.mTransformation),
           group.empty() ? child.mName.C_Str() : group);
    }
  }

 private:
  const aiScene& scene_;
  const fs::path& path_;
  MaterialReader& materials_;
  MeshFile* file_;
};

}  // namespace

bool is_mesh_file(const fs::path& path) {
  constexpr std::array kEndings = {".dae", ".obj", ".stl", ".gltf", ".glb", ".ply"};
  return std::find(kEndings.begin(), kEndings.end(), ending_of(path)) != kEndings.end();
}

Expected<MeshFile> read_mesh_file(const fs::path& path, const MeshFileOptions& options,
                                  TextureStore& textures) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return fail(path.string() + ": no such mesh file");
  if (!is_mesh_file(path)) {
    return fail(path.string() + ": expected a mesh, .dae, .obj, .stl, .gltf, .glb or .ply");
  }
  const auto frame = root_frame(path, options);
  if (!frame) return tl::unexpected(frame.error());
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  MeshFile file;
  try {
    const aiScene* const scene = read_triangles(importer, path);
    if (scene == nullptr || scene->mRootNode == nullptr) {
      return fail(path.string() + ": cannot be read: " + importer.GetErrorString());
    }
    const std::string ending = ending_of(path);
    MaterialReader materials(*scene, path, textures, &file.notices);
    materials.set_dialect(ending == ".dae"                        ? MaterialDialect::collada
                          : ending == ".gltf" || ending == ".glb" ? MaterialDialect::gltf
                                                                  : MaterialDialect::plain);
    Gatherer(*scene, path, materials, &file)
        .walk(*scene->mRootNode, frame->of(*scene->mRootNode), "");
  } catch (const std::exception& error) {
    return fail(path.string() + ": cannot be read: " + error.what());
  }
  if (file.pieces.empty()) return fail(path.string() + ": holds no triangles");
  return file;
}

}  // namespace canopeer
