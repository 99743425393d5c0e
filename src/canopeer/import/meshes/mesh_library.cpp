#include "canopeer/import/meshes/mesh_library.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "canopeer/base/atomic_file.h"
#include "canopeer/import/meshes/plain_gltf.h"
#include "canopeer/import/meshes/plain_ply.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

Eigen::Affine3d to_affine(const aiMatrix4x4& m) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  T.matrix().topRows<3>() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4;
  return T;
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

/// A file in other words where the library would take it wrong; empty: as it is.
struct PlainFile {
  std::string bytes;
  const char* format = "";
};

PlainFile plain_file(const fs::path& path, MaterialDialect dialect) {
  if (dialect == MaterialDialect::gltf) return {plain_gltf(path), "glb"};
  std::string first(3, ' ');
  std::ifstream(path, std::ios::binary).read(first.data(), 3);
  if (first != "ply") return {};
  const auto bytes = read_file(path);
  if (!bytes) throw std::runtime_error(bytes.error().message);
  return {plain_ply(*bytes), "ply"};
}

const aiScene* parse(Assimp::Importer& importer, const fs::path& path, const PlainFile& plain,
                     unsigned steps) {
  if (plain.bytes.empty()) return importer.ReadFile(path.string(), steps);
  return importer.ReadFileFromMemory(plain.bytes.data(), plain.bytes.size(), steps, plain.format);
}

/// The file's scene, all of it triangles; nullptr when the library cannot read it.
const aiScene* read_triangles(Assimp::Importer& importer, const fs::path& path,
                              const PlainFile& plain) {
  constexpr unsigned kCheck = aiProcess_ValidateDataStructure;
  unsigned later = aiProcess_Triangulate | aiProcess_SortByPType;
  if (parse(importer, path, plain, kCheck) == nullptr) {
    // Its own reader of OBJ miscounts kinds of faces, which is put right below and checked then.
    const std::string reason = importer.GetErrorString();
    if (reason.find("does not report the") == std::string::npos) return nullptr;
    if (parse(importer, path, plain, 0) == nullptr) return nullptr;
    later |= kCheck;
  }
  const aiScene* const scene = importer.GetScene();
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) repair_faces(*scene->mMeshes[i]);
  return importer.ApplyPostProcessing(later);
}

/// Whether the library refuses a file because there are only points and lines in it, or nothing.
bool is_without_triangles(const std::string& reason) {
  constexpr std::array kReasons = {"No meshes remaining",         "contains no faces",
                                   "contains no vertices",        "mNumMeshes is 0",
                                   "There are no facets defined", "has no faces"};
  return std::any_of(kReasons.begin(), kReasons.end(),
                     [&](const char* words) { return reason.find(words) != std::string::npos; });
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

Rgb product(Rgb a, Rgb b) {
  const auto scaled = [](int x, int y) { return static_cast<std::uint8_t>((x * y + 127) / 255); };
  return {scaled(a.r, b.r), scaled(a.g, b.g), scaled(a.b, b.b)};
}

/// What the format makes of vertex colours beside the material's.
void mix_colors(const FileMaterial& material, MaterialDialect dialect, MeshPiece* piece) {
  if (dialect == MaterialDialect::collada) piece->vertex_colors.clear();
  if (dialect == MaterialDialect::gltf) {
    for (Rgb& c : piece->vertex_colors) c = product(c, material.color);
  }
}

/// Damaged matrices and numbers beyond a float's make coordinates that are none.
MeshPiece only_finite(MeshPiece piece) {
  std::vector<int> finite;
  for (const auto& t : piece.mesh.triangles) {
    finite.push_back(std::all_of(
        t.begin(), t.end(), [&](std::uint32_t k) { return piece.mesh.vertices[k].allFinite(); }));
  }
  const bool all = std::all_of(piece.mesh.vertices.begin(), piece.mesh.vertices.end(),
                               [](const auto& v) { return v.allFinite(); });
  return all ? std::move(piece) : selected(piece, finite, 1);
}

/// Walks the nodes and gathers their meshes, in metres and upright.
class Gatherer {
 public:
  Gatherer(const aiScene& scene, MaterialDialect dialect, FileMesh* file)
      : scene_(scene), dialect_(dialect), file_(file) {}

  void read_materials() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      const aiMaterial& material = *scene_.mMaterials[i];
      file_->materials.push_back(read_file_material(material, dialect_));
      add_picture(file_->materials.back().picture);
      add_picture(file_->materials.back().mask);
      const std::string doubt = opacity_in_doubt(material, dialect_);
      if (!doubt.empty()) file_->notices.push_back(doubt);
    }
  }

  void walk(const aiNode& node, const Eigen::Affine3d& T_world_node, const std::string& group) {
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) continue;
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      MeshPiece piece = only_finite(placed(without_copies(to_piece(mesh)), T_world_node));
      if (piece.mesh.triangles.empty()) continue;
      piece.names.node = node.mName.C_Str();
      const std::uint32_t material =
          mesh.mMaterialIndex < file_->materials.size() ? mesh.mMaterialIndex : 0;
      if (!file_->materials.empty()) mix_colors(file_->materials[material], dialect_, &piece);
      file_->parts.push_back({std::move(piece), material, group});
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      const aiNode& child = *node.mChildren[i];
      walk(child, T_world_node * to_affine(child.mTransformation),
           group.empty() ? child.mName.C_Str() : group);
    }
  }

 private:
  void add_picture(const std::string& reference) {
    const aiTexture* const texture =
        reference.empty() ? nullptr : scene_.GetEmbeddedTexture(reference.c_str());
    // Height 0: a whole picture file of mWidth bytes.
    if (texture == nullptr || texture->mHeight != 0) return;
    file_->pictures.emplace(
        reference, std::string(reinterpret_cast<const char*>(texture->pcData), texture->mWidth));
  }

  const aiScene& scene_;
  MaterialDialect dialect_;
  FileMesh* file_;
};

}  // namespace

FileMesh read_with_library(const fs::path& path, const RootFrame& frame, MaterialDialect dialect) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // shapes of no file
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* const scene = read_triangles(importer, path, plain_file(path, dialect));
  if (scene == nullptr && is_without_triangles(importer.GetErrorString())) return {};
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string reason = importer.GetErrorString();
    const bool other = reason.find("No suitable reader") != std::string::npos;
    throw std::runtime_error(other ? "what is in it is not what its ending says" : reason);
  }
  FileMesh file;
  Gatherer gatherer(*scene, dialect, &file);
  gatherer.read_materials();
  const Eigen::Affine3d T = frame.T_upright_root * Eigen::Scaling(frame.unit_m) *
                            to_affine(scene->mRootNode->mTransformation) *
                            Eigen::Scaling(1.0 / frame.unit_m);
  gatherer.walk(*scene->mRootNode, T, "");
  return file;
}

}  // namespace canopeer
