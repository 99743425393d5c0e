#include "canopeer/config/robot_mesh.h"

#include <algorithm>
#include <set>

#include "canopeer/base/percent_encoding.h"
#include "canopeer/config/yaml_document.h"
#include "canopeer/import/mesh_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// Of a vertex, in metres: no robot is that large.
constexpr float kFarthestM = 1e4F;

bool is_file(const fs::path& path) {
  std::error_code code;
  return fs::is_regular_file(path, code);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  });
  return text;
}

/// What a name may be spelled for, as it stands first.
std::vector<std::string> spellings(const std::string& name) {
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  std::vector<std::string> all;
  for (const std::string& text : {name, percent_decoded(name), slashes, percent_decoded(slashes)}) {
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
  }
  return all;
}

struct MeshUri {
  std::string scheme;  // empty: a path
  std::string rest;
};

MeshUri split(std::string name) {
  const auto blank = [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; };
  while (!name.empty() && blank(name.back())) name.pop_back();
  while (!name.empty() && blank(name.front())) name.erase(0, 1);
  const auto colon = name.find("://");
  if (colon != std::string::npos) {
    MeshUri uri{lower(name.substr(0, colon)), name.substr(colon + 3)};
    if (uri.scheme == "file" && uri.rest.rfind("localhost/", 0) == 0) uri.rest.erase(0, 9);
    if (uri.scheme != "file") uri.rest.erase(0, uri.rest.find_first_not_of('/'));
    return uri;
  }
  if (lower(name.substr(0, 6)) == "file:/") return {"file", name.substr(5)};
  return {"", name};
}

std::string listed(const std::vector<fs::path>& folders) {
  std::string text;
  for (const fs::path& folder : folders) text += (text.empty() ? "" : ", ") + folder.string();
  return text;
}

/// Of the files beside `wanted` the one that is likeliest meant; empty: none.
std::string near_name_beside(const fs::path& wanted) {
  std::set<std::string, std::less<>> names;
  std::error_code code;
  for (fs::directory_iterator it(wanted.parent_path(), code), end; !code && it != end;
       it.increment(code)) {
    if (is_mesh_file(it->path()) && is_file(it->path()))
      names.insert(it->path().filename().string());
  }
  const fs::path file = wanted.filename();
  for (const std::string& name : names) {
    if (lower(name) == lower(file.string())) return name;
  }
  for (const std::string& name : names) {
    if (lower(fs::path(name).stem().string()) == lower(file.stem().string())) return name;
  }
  return nearest_name(file.string(), names);
}

}  // namespace

RobotMeshReader::RobotMeshReader(const MeshSearch& search)
    : directory_(search.directory), packages_(search.directory, search.package_path) {}

/// A file there is in place of one of `wanted`; empty: none.
std::string RobotMeshReader::near(const std::vector<fs::path>& wanted) const {
  for (const fs::path& path : wanted) {
    const std::string name = near_name_beside(path);
    if (!name.empty()) return (path.parent_path() / name).string();
  }
  // Written on another machine, or meant from another folder: a tail of the path may be right.
  const std::vector<fs::path> above = packages_.above();
  for (const fs::path& path : wanted) {
    std::vector<fs::path> parts(path.begin(), path.end());
    for (std::size_t first = 1; first < parts.size(); ++first) {
      fs::path tail;
      for (std::size_t i = first; i < parts.size(); ++i) tail /= parts[i];
      for (const fs::path& folder : above) {
        if (is_file(folder / tail)) return (folder / tail).string();
      }
    }
  }
  return {};
}

tl::expected<fs::path, MeshTrouble> RobotMeshReader::find(const std::string& name) {
  const MeshUri uri = split(name);
  if (uri.scheme.empty() || uri.scheme == "file") {
    std::vector<fs::path> wanted;
    for (const std::string& rest : spellings(uri.rest)) {
      wanted.push_back(directory_ / rest);
      if (is_file(wanted.back())) return wanted.back();
    }
    return tl::unexpected(MeshTrouble{
        "not found; looked for " + wanted.front().lexically_normal().string(), near(wanted)});
  }
  if (uri.scheme != "package" && uri.scheme != "model")
    return tl::unexpected(
        MeshTrouble{"cannot be fetched; expected package://, model://, file:// or a path", ""});
  const auto slash = uri.rest.find_first_of("/\\");
  if (slash == std::string::npos)
    return tl::unexpected(MeshTrouble{"names no file; expected package://PACKAGE/FILE", ""});
  const std::string package = percent_decoded(uri.rest.substr(0, slash));
  std::vector<fs::path> wanted;
  std::vector<fs::path> folders;
  for (const bool thorough : {false, true}) {
    folders = packages_.folders_of(package, thorough);
    for (const std::string& rest : spellings(uri.rest.substr(slash + 1))) {
      for (const fs::path& folder : folders) {
        wanted.push_back(folder / rest);
        if (is_file(wanted.back())) return wanted.back();
      }
    }
  }
  if (!folders.empty())
    return tl::unexpected(MeshTrouble{"not found; looked in " + listed(folders) + " (another '" +
                                          package + "' is named by package_path in the robot file)",
                                      near(wanted)});
  std::string what =
      "not found; looked in " + listed(packages_.starts()) + " for a package '" + package +
      "' (a folder of that name, or one whose package.xml has it; add the folder that "
      "holds it to package_path in the robot file";
  const std::string other = packages_.nearest(package);
  if (!other.empty()) what += "; there is a package '" + other + "'";
  return tl::unexpected(MeshTrouble{what + ")", near({fs::path("/") / uri.rest})});
}

tl::expected<CollisionShape, MeshTrouble> RobotMeshReader::load(const std::string& name,
                                                                const Vec3& scale,
                                                                const Pose& T_link_mesh) {
  const auto path = find(name);
  if (!path) return tl::unexpected(path.error());
  const auto trouble = [&](const std::string& what) {
    return tl::unexpected(MeshTrouble{what, ""});
  };
  const std::pair key(path->lexically_normal().string(),
                      std::vector<double>{scale.x(), scale.y(), scale.z()});
  auto known = read_.find(key);
  if (known == read_.end()) {
    if (!(scale.cwiseAbs().minCoeff() > 0.0)) return trouble("has a scale with a zero in it");
    MeshFileOptions options;
    options.honour_up_axis = false;
    TextureStore textures;
    auto file = read_mesh_file(*path, options, textures);
    if (!file) return trouble("cannot be used: " + file.error().message);
    TriangleMesh all;
    for (const MeshPiece& piece : file->pieces) all.append(piece.mesh);
    all.normals.clear();
    if (all.triangles.empty())
      return trouble("cannot be used: " + path->string() + ": no triangles in it");
    for (auto& vertex : all.vertices) {
      vertex = vertex.cwiseProduct(scale.cast<float>());
      if (!(vertex.cwiseAbs().maxCoeff() <= kFarthestM))
        return trouble("cannot be used: " + path->string() + ": a vertex is no number below 1e4");
    }
    if (scale.prod() < 0.0) {  // mirrored: what was outside must stay outside
      for (auto& triangle : all.triangles) std::swap(triangle[1], triangle[2]);
    }
    known =
        read_
            .emplace(key, CollisionShape::of_mesh(std::move(all), Pose::Identity(), path->string()))
            .first;
  }
  CollisionShape shape = known->second;
  shape.T_link_shape = T_link_mesh * shape.T_link_shape;
  return shape;
}

}  // namespace canopeer
