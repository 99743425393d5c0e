#include "canopeer/import/world_import.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>

#include "canopeer/import/mesh_file.h"
#include "canopeer/import/sdf/model_paths.h"
#include "canopeer/import/sdf/sdf_world.h"
#include "canopeer/scene/scene_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMissingShown = 12;
constexpr double kFarthest_m = 1e5;      // beyond it floats have no centimetres left
constexpr double kLongestFruit_m = 0.6;  // no fruit in a glasshouse is
constexpr double kSmallestPlant_m = 0.01;
constexpr double kLargestPlant_m = 20.0;

/// Reads each mesh file once; its notices are passed on once.
class MeshStore {
 public:
  explicit MeshStore(const MeshFileOptions& options) : options_(options) {}

  Expected<const MeshFile*> get(const fs::path& path, std::vector<std::string>* notices) {
    const std::string key = path.string();
    auto known = files_.find(key);
    if (known == files_.end()) {
      auto file = read_mesh_file(path, options_, textures_);
      if (!file) return tl::unexpected(file.error());
      notices->insert(notices->end(), file->notices.begin(), file->notices.end());
      known = files_.emplace(key, std::move(*file)).first;
    }
    return &known->second;
  }
  TextureStore& textures() { return textures_; }

 private:
  MeshFileOptions options_;
  TextureStore textures_;
  std::map<std::string, MeshFile> files_;
};

/// SDF's <submesh>: the piece with this name, or with this node's.
bool in_submesh(const MeshPiece& piece, const std::string& submesh) {
  return submesh.empty() || piece.names.mesh == submesh || piece.names.node == submesh;
}

/// Takes the middle of the pieces' box to the origin.
void centre(std::vector<MeshPiece>* pieces) {
  Box box;
  for (const MeshPiece& piece : *pieces) box.extend(piece.mesh.bounds());
  if (box.isEmpty()) return;
  const Eigen::Affine3d T(Eigen::Translation3d(-box.center()));
  for (MeshPiece& piece : *pieces) piece = placed(piece, T);
}

/// What an SDF material says goes over what the mesh says.
void apply_material(const SdfVisual& visual, TextureStore& textures, MeshPiece* piece,
                    std::vector<std::string>* notices) {
  if (visual.material.color) {
    piece->color = *visual.material.color;
    piece->texture = nullptr;
    piece->vertex_colors.clear();
  }
  if (visual.material.texture && !piece->uv.empty()) {
    if (auto texture = textures.get(*visual.material.texture)) {
      piece->texture = *texture;
    } else {
      notices->push_back("texture " + texture.error().message + "; " + visual.where +
                         " refers to it; going on without this texture");
    }
  }
  if (visual.material.texture) {
    piece->names.textures.push_back(visual.material.texture->filename().string());
  }
  if (piece->names.material.empty() || !visual.material.name.empty()) {
    // Both names count: the script's stands where textures do when the mesh has its own.
    if (!piece->names.material.empty()) piece->names.textures.push_back(visual.material.name);
    if (piece->names.material.empty()) piece->names.material = visual.material.name;
  }
  piece->see_through = piece->see_through || visual.see_through;
  piece->names.visual = visual.names.visual;
  piece->names.link = visual.names.link;
  piece->names.model = visual.names.model;
}

Expected<std::vector<MeshPiece>> pieces_of(const SdfVisual& visual, MeshStore& meshes,
                                           std::vector<std::string>* notices) {
  std::vector<MeshPiece> pieces;
  if (visual.mesh.empty()) {
    pieces.emplace_back().mesh = visual.primitive;
  } else {
    const auto file = meshes.get(visual.mesh, notices);
    if (!file) {
      return fail(file.error().message + " (" + visual.where + ": visual '" + visual.names.visual +
                  "' of model '" + visual.names.model + "' refers to it)");
    }
    std::copy_if((*file)->pieces.begin(), (*file)->pieces.end(), std::back_inserter(pieces),
                 [&](const MeshPiece& piece) { return in_submesh(piece, visual.submesh); });
    if (pieces.empty()) {
      return fail(visual.where + ": <submesh><name>" + visual.submesh + ": no such mesh in " +
                  visual.mesh.string());
    }
    if (visual.center_submesh) centre(&pieces);
  }
  for (MeshPiece& piece : pieces) {
    apply_material(visual, meshes.textures(), &piece, notices);
    piece = placed(piece, visual.T_world_visual);
  }
  return pieces;
}

/// Every visual of an SDF world as pieces in their places.
Expected<std::vector<MeshPiece>> sdf_pieces(const WorldImportOptions& options, std::string* name,
                                            std::vector<std::string>* notices,
                                            const ImportProgressCallback& progress) {
  for (const fs::path& folder : options.model_paths) {
    std::error_code code;
    if (!fs::is_directory(folder, code)) {
      return fail("model path " + folder.string() + ": no such folder");
    }
  }
  auto world = read_sdf_world(options.file, ModelPaths(options.model_paths, options.fuel_caches));
  if (!world) return tl::unexpected(world.error());
  *name = world->name;
  *notices = world->notices;
  MeshStore meshes({options.honour_up_axis});
  std::vector<MeshPiece> all;
  ImportProgress at{0, world->visuals.size(), 0};
  for (const SdfVisual& visual : world->visuals) {
    auto pieces = pieces_of(visual, meshes, notices);
    if (!pieces) return tl::unexpected(pieces.error());
    for (MeshPiece& piece : *pieces) {
      at.triangles += piece.mesh.triangles.size();
      all.push_back(std::move(piece));
    }
    ++at.done;
    if (progress) progress(at);
  }
  return all;
}

/// A lone mesh file: each child of its root is a model.
Expected<std::vector<MeshPiece>> lone_mesh_pieces(const WorldImportOptions& options,
                                                  std::string* name,
                                                  std::vector<std::string>* notices,
                                                  const ImportProgressCallback& progress) {
  TextureStore textures;
  auto file = read_mesh_file(options.file, {options.honour_up_axis}, textures);
  if (!file) return tl::unexpected(file.error());
  *name = options.file.stem().string();
  *notices = file->notices;
  ImportProgress at{1, 1, 0};
  for (std::size_t i = 0; i < file->pieces.size(); ++i) {
    file->pieces[i].names.model = file->groups[i];
    at.triangles += file->pieces[i].mesh.triangles.size();
  }
  if (progress) progress(at);
  return std::move(file->pieces);
}

/// The names there are, for someone whose pattern matched none.
std::string names_in(const std::vector<PartsRow>& parts) {
  std::set<std::string> names;
  for (const PartsRow& row : parts) {
    for (const std::string& name : all_names(row.names)) {
      if (!name.empty()) names.insert(name);
    }
  }
  std::string text;
  std::size_t shown = 0;
  for (const std::string& name : names) {
    if (shown++ == kMissingShown) return text + ", …";
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

/// A coordinate that no world has comes from a unit, a scale or a pose that is wrong.
Expected<void> check_size(const std::vector<MeshPiece>& pieces) {
  for (const MeshPiece& piece : pieces) {
    const Box box = piece.mesh.bounds();
    const double reach =
        box.isEmpty() ? 0.0 : std::max(-box.min().minCoeff(), box.max().maxCoeff());
    if (reach <= kFarthest_m) continue;
    const PartNames& names = piece.names;
    return fail("model '" + names.model + "'" +
                (names.visual.empty() ? "" : ", visual '" + names.visual + "'") +
                (names.file.empty() ? "" : ", mesh " + names.file) + ": reaches " +
                std::to_string(static_cast<long long>(std::min(reach / 1000.0, 1e15))) +
                " km from the origin; expected metres: look at its unit, scale and pose");
  }
  return {};
}

/// A mesh taken as metres that is in millimetres has fruits of seventy metres.
void note_odd_sizes(ImportedScene* result) {
  const FruitTruth* longest = nullptr;
  for (const FruitTruth& fruit : result->scene.fruits) {
    if (longest == nullptr || fruit.length_m > longest->length_m) longest = &fruit;
  }
  if (longest == nullptr || longest->length_m <= kLongestFruit_m) return;
  std::array<char, 32> length{};
  std::snprintf(length.data(), length.size(), "%.1f", longest->length_m);
  result->notices.push_back("a fruit of model '" + longest->model + "' is " + length.data() +
                            " m long: either its mesh's unit or scale is wrong, or a pattern takes "
                            "more than fruits");
}

/// A lone mesh whose format names no unit and whose size is no plant's.
void note_odd_unit(const fs::path& file, const std::vector<MeshPiece>& pieces,
                   std::vector<std::string>* notices) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".obj" && ending != ".stl" && ending != ".ply") return;
  Box box;
  for (const MeshPiece& piece : pieces) box.extend(piece.mesh.bounds());
  const double size = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (size <= 0.0 || (size >= kSmallestPlant_m && size <= kLargestPlant_m)) return;
  std::array<char, 320> text{};
  std::snprintf(
      text.data(), text.size(),
      ": is %.4g m in size, since %s names no unit and metres are taken; in millimetres it "
      "would be %.4g m, in centimetres %.4g m, in inches %.4g m: say so with unit_m in a "
      "scene file or <scale> in an SDF world",
      size, ending.c_str(), size * 1e-3, size * 1e-2, size * 0.0254);
  notices->push_back(file.string() + text.data());
}

void note_what_is_missing(const NamePatternOptions& patterns, ImportedScene* result) {
  if (patterns.fruit.empty()) {
    result->notices.push_back("no pattern for fruits was given, so there are none; names are: " +
                              names_in(result->parts));
  } else if (result->scene.fruits.empty()) {
    result->notices.push_back("no fruit: no surface of fruit size has a name that matches '" +
                              patterns.fruit + "'; names are: " + names_in(result->parts));
  } else if (result->scene.counted_fruits() == 0) {
    result->notices.push_back("no fruit counts: no fruit has a name that matches '" +
                              patterns.counted + "'");
  }
}

}  // namespace

Expected<ImportedScene> import_world(const WorldImportOptions& options,
                                     const ImportProgressCallback& progress) {
  if (is_frozen_scene(options.file)) {
    ImportedScene frozen;
    auto scene = read_scene_file(options.file);
    if (!scene) return tl::unexpected(scene.error());
    frozen.scene = std::move(*scene);
    return frozen;
  }
  const auto patterns = NamePatterns::compile(options.patterns);
  if (!patterns) return tl::unexpected(patterns.error());
  std::string name;
  std::vector<std::string> notices;
  auto pieces = is_mesh_file(options.file) ? lone_mesh_pieces(options, &name, &notices, progress)
                                           : sdf_pieces(options, &name, &notices, progress);
  if (!pieces) return tl::unexpected(pieces.error());
  if (pieces->empty()) return fail(options.file.string() + ": shows nothing: expected a visual");
  if (auto ok = check_size(*pieces); !ok) return fail_in(options.file.string(), ok.error());
  note_odd_unit(options.file, *pieces, &notices);
  auto classified = classify(std::move(*pieces), *patterns);
  if (classified.empty()) {
    return fail(options.file.string() + ": nothing is left: the pattern for what to skip, '" +
                options.patterns.skip + "', matches all");
  }
  ImportedScene result = assemble_scene(name, std::move(classified), options.fruits);
  result.notices.insert(result.notices.begin(), notices.begin(), notices.end());
  note_what_is_missing(options.patterns, &result);
  note_odd_sizes(&result);
  return result;
}

}  // namespace canopeer
