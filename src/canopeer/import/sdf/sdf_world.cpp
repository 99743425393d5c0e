#include "canopeer/import/sdf/sdf_world.h"

#include <algorithm>

#include "canopeer/import/sdf/sdf_frames.h"
#include "canopeer/import/sdf/sdf_shape.h"
#include "canopeer/import/sdf/sdf_state.h"
#include "canopeer/import/sdf/sdf_tree.h"
#include "canopeer/import/shape_mesh.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// A model where it stands, as <state> or its own pose say.
struct PlacedModel {
  std::string name;  ///< full, "row::plant_3"; of the world: empty
  Pose T_world = Pose::Identity();
  Vec3 scale = Vec3::Ones();
};

class WorldReader {
 public:
  WorldReader(const SdfFile& file, const ModelPaths& paths)
      : file_(file), paths_(paths), includes_(paths) {}

  Expected<SdfWorld> read();

 private:
  Expected<void> add_tree(const SdfElement& element);
  Expected<void> add_models(const SdfScope& scope, const PlacedModel& placed);
  Expected<void> add_model(const SdfScope& model, const PlacedModel& parent);
  Expected<void> add_merged(const SdfScope& model, const PlacedModel& parent);
  Expected<void> add_links(const SdfScope& scope, const PlacedModel& placed);
  Expected<void> add_link(const SdfElement& link, const SdfScope& scope, const PlacedModel& placed);
  void add_ground();

  const SdfFile& file_;
  const ModelPaths& paths_;
  SdfIncludes includes_;
  std::vector<SdfTree> trees_;  ///< the world's own, then those of insertions
  SdfFrames frames_;
  SdfState state_;
  SdfWorld world_;
  MissingFiles missing_;  ///< meshes
};

void WorldReader::add_ground() {
  SdfVisual ground;
  ground.primitive = plane_mesh(Vec3::UnitZ(), 100.0, 100.0);
  ground.material.color = Rgb{160, 160, 160};
  ground.names.model = "ground_plane";
  ground.where = file_.path().string();
  world_.visuals.push_back(std::move(ground));
}

Expected<void> WorldReader::add_link(const SdfElement& link, const SdfScope& scope,
                                     const PlacedModel& placed) {
  const auto T_model_link = frames_.frame(scope, link.name());
  if (!T_model_link) return tl::unexpected(T_model_link.error());
  const std::string name = placed.name + "::" + link.name();
  Pose T_world_link = placed.T_world * *T_model_link;
  const SdfState::Entry* const state = state_.link(name);
  if (state != nullptr && state->T_world) T_world_link = *state->T_world;
  // Until SDF 1.7 the links of a model within were written as links of the outer one,
  // "inner::link".
  const std::size_t last = name.rfind("::");
  for (const SdfElement& from : link.children("visual")) {
    const SdfPlace place{from.child("pose"), "", from, Vec3::Zero()};
    const auto T_link_visual = frames_.in_link(scope, link.name(), place);
    if (!T_link_visual) return tl::unexpected(T_link_visual.error());
    SdfVisual visual;
    visual.T_world_visual = Eigen::Affine3d(T_world_link) * Eigen::Scaling(placed.scale) *
                            Eigen::Affine3d(*T_link_visual);
    if (!visual.T_world_visual.matrix().allFinite()) {
      return fail(from.where() + ": visual '" + name + "::" + from.name() +
                  "': its pose is not finite");
    }
    visual.names.visual = from.name();
    visual.names.link = name.substr(last + 2);
    visual.names.model = name.substr(0, last);
    const auto shown = read_sdf_shape(from, paths_, &visual, &world_.notices, &missing_);
    if (!shown) return tl::unexpected(shown.error());
    if (*shown) world_.visuals.push_back(std::move(visual));
  }
  return {};
}

/// Where a merged model stands; its parts count as its parent's. The world has no links: there they
/// keep the model's name.
Expected<void> WorldReader::add_merged(const SdfScope& model, const PlacedModel& parent) {
  const auto T_parent_model = frames_.model(model);
  if (!T_parent_model) return tl::unexpected(T_parent_model.error());
  PlacedModel placed = parent;
  placed.T_world = parent.T_world * *T_parent_model;
  if (placed.name.empty()) placed.name = model.name;
  return add_links(model, placed);
}

Expected<void> WorldReader::add_links(const SdfScope& scope, const PlacedModel& placed) {
  for (const SdfPart& part : scope.parts) {
    Expected<void> ok;
    if (!part.model) ok = add_link(part.link, scope, placed);
    if (part.model && part.model->merged) ok = add_merged(*part.model, placed);
    if (!ok) return ok;
  }
  return {};
}

Expected<void> WorldReader::add_models(const SdfScope& scope, const PlacedModel& placed) {
  for (const SdfPart& part : scope.parts) {
    if (!part.model) continue;
    if (auto ok = add_model(*part.model, placed); !ok) return ok;
  }
  return {};
}

Expected<void> WorldReader::add_model(const SdfScope& model, const PlacedModel& parent) {
  const auto T_parent_model = frames_.model(model);
  if (!T_parent_model) return tl::unexpected(T_parent_model.error());
  PlacedModel placed = parent;
  placed.T_world = parent.T_world * *T_parent_model;
  if (model.merged) return add_models(model, placed);
  placed.name += (parent.name.empty() ? "" : "::") + model.name;
  if (state_.deleted.count(placed.name) != 0) return {};
  if (const SdfState::Entry* const state = state_.model(placed.name)) {
    if (state->T_world) placed.T_world = *state->T_world;
    placed.scale = state->scale;
  }
  if (auto ok = add_links(model, placed); !ok) return ok;
  return add_models(model, placed);
}

Expected<void> WorldReader::add_tree(const SdfElement& element) {
  auto read = read_sdf_tree(element, includes_);
  if (!read) return tl::unexpected(read.error());
  const SdfTree& tree = trees_.emplace_back(std::move(*read));
  world_.notices.insert(world_.notices.end(), tree.notices.begin(), tree.notices.end());
  if (tree.lacks_ground) add_ground();
  const PlacedModel world;
  for (const SdfPart& part : tree.world->parts) {
    if (!part.model || !part.model->merged) continue;
    if (auto ok = add_merged(*part.model, world); !ok) return ok;
  }
  return add_models(*tree.world, world);
}

Expected<SdfWorld> WorldReader::read() {
  const SdfElement root = file_.root();
  if (file_.is_urdf()) {
    return fail(root.where() +
                ": expected <sdf version=…> at the root, found <robot>: the robot "
                "comes from the mission, by its robot.yaml");
  }
  const SdfElement world = root.child("world");
  if (!world && !root.child("model") && !root.child("include")) {
    return fail(file_.path().string() + ": expected a <world> or a <model> in <sdf>");
  }
  if (file_.version() > kNewestSdf) {
    world_.notices.push_back(root.where() + ": SDF " + root.attribute("version").value_or("") +
                             " is newer than what is known; read as " +
                             std::to_string(kNewestSdf.major) + "." +
                             std::to_string(kNewestSdf.minor));
  }
  world_.name = world.name().empty() ? file_.path().stem().string() : world.name();
  auto state = read_sdf_state(world);
  if (!state) return tl::unexpected(state.error());
  state_ = std::move(*state);
  if (auto ok = add_tree(world ? world : root); !ok) return tl::unexpected(ok.error());
  // Models that were put into a running world stand in its <state>, whole, in a frame of their own.
  for (const SdfElement& insertions : state_.insertions) {
    if (auto ok = add_tree(insertions); !ok) return tl::unexpected(ok.error());
  }
  if (auto ok = missing_.check("meshes"); !ok) return tl::unexpected(ok.error());
  return std::move(world_);
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// Names and texts of a file may hold ends of lines; messages do not.
Expected<SdfWorld> read_world(const Expected<std::unique_ptr<const SdfFile>>& file,
                              const ModelPaths& paths) {
  if (!file) return tl::unexpected(file.error());
  auto world = WorldReader(**file, paths).read();
  if (!world) return fail(one_line(world.error().message));
  for (std::string& notice : world->notices) notice = one_line(notice);
  return world;
}

}  // namespace

Expected<SdfWorld> parse_sdf_world(std::string_view text, const fs::path& path,
                                   const ModelPaths& paths) {
  return read_world(SdfFile::parse(text, path), paths);
}

Expected<SdfWorld> read_sdf_world(const fs::path& path, const ModelPaths& paths) {
  std::error_code code;
  if (fs::is_directory(path, code)) {
    return fail(path.string() + ": is a folder; expected a .world or .sdf file, or a mesh");
  }
  if (!fs::is_regular_file(path, code)) return fail(path.string() + ": no such file");
  return read_world(SdfFile::read(path), paths);
}

}  // namespace canopeer
