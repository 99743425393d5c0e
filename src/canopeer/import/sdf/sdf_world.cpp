#include "canopeer/import/sdf/sdf_world.h"

#include <console_bridge/console.h>

#include <algorithm>
#include <functional>
#include <mutex>
#include <sdf/Console.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>

#include "canopeer/import/sdf/sdf_convert.h"
#include "canopeer/import/sdf/sdf_shape.h"
#include "canopeer/import/sdf/sdf_state.h"
#include "canopeer/import/sdf/sdf_syntax.h"
#include "canopeer/import/shape_mesh.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

/// Models that every Gazebo has and few people keep beside their worlds.
constexpr const char* kSun = "model://sun";
constexpr const char* kGround = "model://ground_plane";

/// How the library finds what is included. It asks for relative names without saying who includes
/// them; as it reads depth first, the model found last is the one that asks.
class IncludeFinder {
 public:
  IncludeFinder(const ModelPaths& paths, fs::path world_folder)
      : paths_(paths), folders_{std::move(world_folder)} {}

  std::string find(const std::string& uri) {
    for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) {
      const auto found = paths_.find(uri, *folder);
      if (!found) continue;
      const fs::path result = *found;  // `folder` dies with the next line
      folders_.push_back(fs::is_directory(result) ? result : result.parent_path());
      return result.string();
    }
    return {};
  }

 private:
  const ModelPaths& paths_;
  std::vector<fs::path> folders_;
};

/// Has the library ask us wherever it does not know better, and keep quiet, as long as this lives.
/// One at a time.
class GlobalFinder {
 public:
  explicit GlobalFinder(std::function<std::string(const std::string&)> find) : lock_(mutex()) {
    sdf::ParserConfig::GlobalConfig().SetFindCallback(std::move(find));
    // What is no SDF it tries as URDF, whose parser complains to whoever listens.
    console_bridge::noOutputHandler();
  }
  GlobalFinder(const GlobalFinder&) = delete;
  GlobalFinder& operator=(const GlobalFinder&) = delete;
  ~GlobalFinder() {
    console_bridge::restorePreviousOutputHandler();
    sdf::ParserConfig::GlobalConfig().SetFindCallback({});
  }

 private:
  static std::mutex& mutex() {
    static std::mutex only;
    return only;
  }
  std::lock_guard<std::mutex> lock_;
};

/// Errors of the library about what has neither shape nor place.
bool harmless(sdf::ErrorCode code) {
  switch (code) {
    case sdf::ErrorCode::MODEL_WITHOUT_LINK:
    case sdf::ErrorCode::MODEL_CANONICAL_LINK_INVALID:
    case sdf::ErrorCode::LINK_INERTIA_INVALID:
    case sdf::ErrorCode::JOINT_CHILD_LINK_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_LINK_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_SAME_AS_CHILD:
    case sdf::ErrorCode::VERSION_DEPRECATED:
    case sdf::ErrorCode::ELEMENT_DEPRECATED:
    case sdf::ErrorCode::ATTRIBUTE_DEPRECATED:
      return true;
    default:
      return false;
  }
}

bool about(const sdf::Error& error, const char* uri) {
  return error.Code() == sdf::ErrorCode::URI_LOOKUP &&
         error.Message().find(std::string("[") + uri + "]") != std::string::npos;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Of an included file that is broken the library says only that it cannot be read.
std::optional<std::string> syntax_error(const sdf::Error& error) {
  for (const std::string start :
       {"Unable to read file:", "Unable to read file: [", "Unable to read file["}) {
    if (!error.Message().starts_with(start)) continue;
    const std::string rest = error.Message().substr(start.size());
    const auto sound = check_sdf_syntax(rest.substr(0, rest.find(']')));
    if (!sound) return sound.error().message;
  }
  return std::nullopt;
}

std::string described(const sdf::Error& error, const fs::path& world) {
  if (const auto syntax = syntax_error(error)) return *syntax;
  std::string text = error.FilePath().value_or(world.string());
  if (error.LineNumber()) text += ":" + std::to_string(*error.LineNumber());
  text += ": ";
  if (error.XmlPath()) text += *error.XmlPath() + ": ";
  text += one_line(error.Message());
  if (error.Code() == sdf::ErrorCode::URI_LOOKUP) {
    text += "; expected a folder with model.config under a --model-path, or beside the file";
  }
  if (error.Code() == sdf::ErrorCode::ELEMENT_INVALID &&
      error.Message().find("<pose>") != std::string::npos) {
    text += "; expected six numbers: x y z roll pitch yaw";
  }
  return text;
}

class WorldReader {
 public:
  WorldReader(fs::path path, const ModelPaths& paths) : path_(std::move(path)), paths_(paths) {}

  Expected<SdfWorld> read();

 private:
  Expected<void> judge(const sdf::Errors& errors);
  Expected<void> add_model(const sdf::Model& model, const std::string& scope,
                           const Pose& T_world_parent, const Vec3& scale);
  Expected<void> add_link(const sdf::Link& link, const std::string& model,
                          const Pose& T_world_model, const Vec3& scale);
  Expected<Pose> resolve(const sdf::SemanticPose& pose, const std::string& what) const;
  void add_ground();
  Expected<void> check_include(const sdf::Model& model) const;
  Expected<void> add_insertions(const sdf::ParserConfig& config);

  fs::path path_;
  const ModelPaths& paths_;
  SdfState state_;
  SdfWorld world_;
};

/// Fatal errors end the reading; the others become notices.
Expected<void> WorldReader::judge(const sdf::Errors& errors) {
  const sdf::Error* fallback = nullptr;
  bool explained = false;
  for (const sdf::Error& error : errors) {
    if (about(error, kSun) || harmless(error.Code())) {
      explained = true;
    } else if (about(error, kGround)) {
      explained = true;
      add_ground();
    } else if (error.Message().starts_with("Failed to load a world") ||
               error.Message().starts_with("Failed to load a model")) {
      fallback = &error;  // says nothing beside the one before it
    } else {
      return fail(described(error, path_));
    }
  }
  if (fallback != nullptr && !explained) return fail(described(*fallback, path_));
  return {};
}

void WorldReader::add_ground() {
  SdfVisual ground;
  ground.primitive = plane_mesh(Vec3::UnitZ(), 100.0, 100.0);
  ground.material.color = Rgb{160, 160, 160};
  ground.names.model = "ground_plane";
  ground.where = path_.string();
  world_.visuals.push_back(std::move(ground));
}

Expected<Pose> WorldReader::resolve(const sdf::SemanticPose& pose, const std::string& what) const {
  ignition::math::Pose3d resolved;
  const sdf::Errors errors = pose.Resolve(resolved);
  if (!errors.empty()) {
    return fail(path_.string() + ": " + what +
                ": its pose cannot be resolved: " + one_line(errors.front().Message()));
  }
  if (!resolved.IsFinite()) return fail(path_.string() + ": " + what + ": its pose is not finite");
  return to_pose(resolved);
}

Expected<void> WorldReader::add_link(const sdf::Link& link, const std::string& model,
                                     const Pose& T_world_model, const Vec3& scale) {
  const std::string name = model + "::" + link.Name();
  auto T_model_link = resolve(link.SemanticPose(), "link '" + name + "'");
  if (!T_model_link) return tl::unexpected(T_model_link.error());
  Pose T_world_link = T_world_model * *T_model_link;
  const SdfState::Entry* const state = state_.link(name);
  if (state != nullptr && state->T_world) T_world_link = *state->T_world;
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    const sdf::Visual& from = *link.VisualByIndex(i);
    auto T_link_visual = resolve(from.SemanticPose(), "visual '" + name + "::" + from.Name() + "'");
    if (!T_link_visual) return tl::unexpected(T_link_visual.error());
    SdfVisual visual;
    visual.T_world_visual =
        Eigen::Affine3d(T_world_link) * Eigen::Scaling(scale) * Eigen::Affine3d(*T_link_visual);
    visual.names.visual = from.Name();
    visual.names.link = link.Name();
    visual.names.model = model;
    auto shown = read_sdf_shape(from, paths_, path_, &visual, &world_.notices);
    if (!shown) return tl::unexpected(shown.error());
    if (*shown) world_.visuals.push_back(std::move(visual));
  }
  return {};
}

/// The library looks for relative includes in the working directory before it asks us. What it
/// finds there must not come in place of what lies beside the file.
Expected<void> WorldReader::check_include(const sdf::Model& model) const {
  const sdf::ElementPtr include = model.Element() ? model.Element()->GetIncludeElement() : nullptr;
  if (!include || !include->HasElement("uri")) return {};
  const auto uri = include->GetElement("uri")->Get<std::string>();
  if (uri.find("://") != std::string::npos || fs::path(uri).is_absolute()) return {};
  const fs::path from = include->FilePath().empty() ? path_ : fs::path(include->FilePath());
  fs::path beside = from.parent_path() / uri;
  fs::path read = fs::path(model.Element()->FilePath()).parent_path();
  std::error_code code;
  if (!fs::exists(beside, code)) return {};
  if (!fs::is_directory(beside, code)) beside = beside.parent_path();
  if (read.empty()) read = ".";
  if (beside.empty() || fs::equivalent(beside, read, code) || code) return {};
  return fail(from.string() + ": <include><uri>" + uri + ": the working directory has a " +
              read.string() + " that hides " + beside.string() + "; run from another directory");
}

Expected<void> WorldReader::add_model(const sdf::Model& model, const std::string& scope,
                                      const Pose& T_world_parent, const Vec3& scale) {
  const std::string name = scope + model.Name();
  if (state_.deleted.count(name) != 0) return {};
  if (auto ok = check_include(model); !ok) return ok;
  auto T_parent_model = resolve(model.SemanticPose(), "model '" + name + "'");
  if (!T_parent_model) return tl::unexpected(T_parent_model.error());
  Pose T_world_model = T_world_parent * *T_parent_model;
  Vec3 own_scale = scale;
  if (const SdfState::Entry* const state = state_.model(name)) {
    if (state->T_world) T_world_model = *state->T_world;
    own_scale = state->scale;
  }
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    auto ok = add_link(*model.LinkByIndex(i), name, T_world_model, own_scale);
    if (!ok) return ok;
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    auto ok = add_model(*model.ModelByIndex(i), name + "::", T_world_model, own_scale);
    if (!ok) return ok;
  }
  return {};
}

/// Models that were put into a running world stand in its <state>, whole. Frames are resolved in
/// worlds only, so they get one of their own; the library has brought them to its own version.
Expected<void> WorldReader::add_insertions(const sdf::ParserConfig& config) {
  if (state_.insertions.empty()) return {};
  sdf::Root root;
  const sdf::Errors errors =
      root.LoadSdfString("<sdf version='" + std::string(SDF_VERSION) +
                             "'><world name='insertions'>" + state_.insertions + "</world></sdf>",
                         config);
  if (auto ok = judge(errors); !ok) return fail_in("<state><insertions>", ok.error());
  if (root.WorldCount() == 0) return {};
  const sdf::World& world = *root.WorldByIndex(0);
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    auto ok = add_model(*world.ModelByIndex(i), "", Pose::Identity(), Vec3::Ones());
    if (!ok) return ok;
  }
  return {};
}

Expected<SdfWorld> WorldReader::read() {
  sdf::Console::Instance()->SetQuiet(true);
  IncludeFinder finder(paths_, path_.parent_path());
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::LOG);
  // The library asks for the world file itself, too. And it forgets our settings when an included
  // model includes another: then it asks by the settings of the process.
  const auto find = [&](const std::string& uri) {
    return uri == path_.string() ? uri : finder.find(uri);
  };
  config.SetFindCallback(find);
  const GlobalFinder global(find);
  sdf::Root root;
  const sdf::Errors errors = root.Load(path_.string(), config);
  if (auto ok = judge(errors); !ok) return tl::unexpected(ok.error());
  world_.name = path_.stem().string();
  if (root.WorldCount() == 0 && root.Model() == nullptr) {
    return fail(path_.string() + ": expected a <world> or a <model> in <sdf>");
  }
  if (root.WorldCount() == 0) {
    auto ok = add_model(*root.Model(), "", Pose::Identity(), Vec3::Ones());
    if (!ok) return tl::unexpected(ok.error());
    return std::move(world_);
  }
  const sdf::World& world = *root.WorldByIndex(0);
  if (!world.Name().empty()) world_.name = world.Name();
  state_ = read_sdf_state(world);
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    auto ok = add_model(*world.ModelByIndex(i), "", Pose::Identity(), Vec3::Ones());
    if (!ok) return tl::unexpected(ok.error());
  }
  if (auto ok = add_insertions(config); !ok) return tl::unexpected(ok.error());
  return std::move(world_);
}

}  // namespace

Expected<SdfWorld> read_sdf_world(const fs::path& path, const ModelPaths& paths) {
  std::error_code code;
  if (fs::is_directory(path, code)) {
    return fail(path.string() + ": is a folder; expected a .world or .sdf file, or a mesh");
  }
  if (!fs::is_regular_file(path, code)) return fail(path.string() + ": no such file");
  if (auto ok = check_sdf_syntax(path); !ok) return tl::unexpected(ok.error());
  try {
    return WorldReader(path, paths).read();
  } catch (const std::exception& error) {
    return fail(path.string() + ": cannot be read as SDF: " + one_line(error.what()));
  }
}

}  // namespace canopeer
