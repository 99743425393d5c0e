#include "canopeer/import/sdf/sdf_tree.h"

#include <algorithm>

#include "canopeer/import/sdf/missing_files.h"
#include "canopeer/import/sdf/sdf_numbers.h"
#include "canopeer/import/sdf/sdf_population.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDeepestModel = 100;  // models in models; bounds the stack
constexpr std::size_t kMostModels = 50000;  // files that include each other twice grow fast
constexpr std::size_t kUnreadShown = 12;

/// A model before its parts are looked at.
struct ModelSource {
  SdfElement element;  ///< <model>
  SdfElement include;  ///< that leads to it; none: it stands where it is
  std::string name;
  SdfPlace place;
  std::string placement_frame;
  bool merged = false;
};

std::string text_or(const SdfElement& element, const std::string& fallback) {
  const std::string text = element.text();
  return text.empty() ? fallback : text;
}

ModelSource source_of(const SdfElement& model) {
  ModelSource source;
  source.element = model;
  source.name = model.name();
  source.place.pose = model.child("pose");
  source.place.owner = model;
  source.placement_frame = model.attribute("placement_frame").value_or("");
  return source;
}

/// Gazebo has both, and few people keep them beside their worlds.
bool everybody_has(const SdfElement& include, const std::string& name) {
  const std::string uri = include.child("uri").text();
  return uri.find("://") != std::string::npos && SdfIncludes::model_name(uri) == name;
}

class TreeReader {
 public:
  explicit TreeReader(SdfIncludes& includes) : includes_(includes) {}

  Expected<SdfTree> read(const SdfElement& world);

 private:
  Expected<void> fill(const SdfElement& element, SdfScope* scope);
  Expected<void> add(const SdfElement& part, SdfScope* scope);
  Expected<void> add_link(const SdfElement& link, SdfScope* scope);
  Expected<void> add_model(const ModelSource& source, SdfScope* scope);
  Expected<void> add_include(const SdfElement& include, SdfScope* scope);
  Expected<void> add_population(const SdfElement& population, SdfScope* scope);
  Expected<std::optional<ModelSource>> included(const SdfElement& include);
  void leave_out(const SdfElement& element);
  void note_what_is_left_out();

  SdfIncludes& includes_;
  SdfTree tree_;
  std::vector<fs::path> chain_;  ///< files that include each other, down to the one being read
  std::size_t depth_ = 0;
  std::size_t models_ = 0;
  std::map<std::string, std::vector<std::string>> left_out_;  ///< names by tag
  MissingFiles missing_;                                      ///< models
};

Expected<void> TreeReader::add_link(const SdfElement& link, SdfScope* scope) {
  if (link.name().empty()) return fail(link.where() + ": <link>: expected a name");
  const SdfPlace place{link.child("pose"), "", link, Vec3::Zero()};
  const auto [known, fresh] = scope->frames.emplace(link.name(), place);
  if (!fresh && known->second.owner.tag() == "link") {
    return fail(link.where() + ": <link> '" + link.name() +
                "': expected a name that no other link of the model has");
  }
  known->second = place;
  scope->parts.push_back({link, nullptr});
  return {};
}

Expected<void> TreeReader::add_model(const ModelSource& source, SdfScope* scope) {
  const SdfElement& asks = source.include ? source.include : source.element;
  const std::string what = asks.where() + ": <model> '" + source.name + "': ";
  if (source.name.empty()) return fail(asks.where() + ": <model>: expected a name");
  if (++models_ > kMostModels) {
    return fail(what + "expected at most " + std::to_string(kMostModels) + " models");
  }
  if (depth_ == kDeepestModel) {
    return fail(what + "models lie within models more than " + std::to_string(kDeepestModel) +
                " deep");
  }
  auto model = std::make_unique<SdfScope>();
  model->name = source.name;
  model->parent = scope;
  model->merged = source.merged;
  model->place = source.place;
  model->placement_frame = source.placement_frame;
  if (!source.merged && !scope->models.emplace(source.name, model.get()).second) {
    return fail(what + "expected a name that no other model beside it has");
  }
  ++depth_;
  auto ok = fill(source.element, model.get());
  --depth_;
  if (!ok) return ok;
  scope->parts.push_back({SdfElement(), std::move(model)});
  return {};
}

/// Nothing: no model, but something that needs none.
Expected<std::optional<ModelSource>> TreeReader::included(const SdfElement& include) {
  const auto file = includes_.find(include);
  if (!file && !include.child("uri").text().empty() && !includes_.exists(include)) {
    if (everybody_has(include, "sun")) return std::nullopt;
    tree_.lacks_ground = tree_.lacks_ground || everybody_has(include, "ground_plane");
    if (everybody_has(include, "ground_plane")) return std::nullopt;
    missing_.add(include.child("uri").text(), file.error());
    return std::nullopt;
  }
  if (!file) return tl::unexpected(file.error());
  if ((*file)->is_urdf()) {
    tree_.notices.push_back((*file)->path().string() + " is URDF and is left out; " +
                            include.where() + " includes it; the robot comes from the mission");
    return std::nullopt;
  }
  const SdfElement root = (*file)->root();
  const SdfElement model = root.child("model");
  if (!model) {
    if (const SdfElement actor = root.child("actor")) leave_out(actor);
    if (root.child("actor") || root.child("light")) return std::nullopt;
    return fail((*file)->path().string() + ": expected a <model> in <sdf> (" + include.where() +
                ": <include> refers to it)");
  }
  ModelSource source = source_of(model);
  source.include = include;
  source.name = text_or(include.child("name"), source.name);
  source.merged = sdf_truth(include.attribute("merge").value_or("false"));
  source.place.owner = include;
  if (const SdfElement pose = include.child("pose")) source.place.pose = pose;
  const std::string placement = include.child("placement_frame").text();
  if (!placement.empty() && !include.child("pose")) {
    return fail(include.where() + ": <placement_frame>: expected a <pose> beside it");
  }
  if (!placement.empty()) source.placement_frame = placement;
  return source;
}

Expected<void> TreeReader::add_include(const SdfElement& include, SdfScope* scope) {
  const auto source = included(include);
  if (!source) return tl::unexpected(source.error());
  if (!*source) return {};
  const fs::path& file = (*source)->element.file().path();
  if (std::find(chain_.begin(), chain_.end(), file) != chain_.end()) {
    return fail(include.where() + ": <include><uri>" + include.child("uri").text() +
                ": goes round in a circle: " + file.string() + " includes itself");
  }
  chain_.push_back(file);
  auto ok = add_model(**source, scope);
  chain_.pop_back();
  return ok;
}

/// Copies of a model, each at a place of its own in the population's frame.
Expected<void> TreeReader::add_population(const SdfElement& population, SdfScope* scope) {
  const auto places = population_places(population);
  if (!places) return tl::unexpected(places.error());
  std::optional<ModelSource> source;
  if (const SdfElement model = population.child("model")) {
    source = source_of(model);
  } else if (const SdfElement include = population.child("include")) {
    auto found = included(include);
    if (!found) return tl::unexpected(found.error());
    source = std::move(*found);
  }
  if (!source && !missing_.empty()) return {};
  if (!source) return fail(population.where() + ": <population>: expected a <model>");
  // No name of an element can have a line's end in it.
  const std::string frame = "\npopulation " + std::to_string(scope->frames.size());
  scope->frames[frame] = {population.child("pose"), "", population, Vec3::Zero()};
  source->merged = false;
  source->place.base = frame;
  const std::string name = source->name;
  for (std::size_t i = 0; i < places->size(); ++i) {
    source->name = name + "_clone_" + std::to_string(i);
    source->place.offset_m = (*places)[i];
    if (auto ok = add_model(*source, scope); !ok) return ok;
  }
  tree_.notices.push_back(population.where() + ": <population> '" + population.name() +
                          "': " + std::to_string(places->size()) + " models '" + name +
                          "' are placed, the same way each time");
  return {};
}

void TreeReader::leave_out(const SdfElement& element) {
  left_out_[std::string(element.tag())].push_back(element.name());
}

Expected<void> TreeReader::add(const SdfElement& part, SdfScope* scope) {
  const std::string_view tag = part.tag();
  if (tag == "link") return add_link(part, scope);
  if (tag == "model") return add_model(source_of(part), scope);
  if (tag == "include") return add_include(part, scope);
  if (tag == "population") return add_population(part, scope);
  if (tag == "frame") {
    const std::string attached_to = part.attribute("attached_to").value_or("");
    scope->frames.try_emplace(part.name(),
                              SdfPlace{part.child("pose"), attached_to, part, Vec3::Zero()});
  } else if (tag == "joint") {
    const std::string child = part.child("child").text();
    scope->frames.try_emplace(part.name(), SdfPlace{part.child("pose"), child, part, Vec3::Zero()});
  } else if (tag == "road" || tag == "actor") {
    leave_out(part);
  }
  return {};
}

Expected<void> TreeReader::fill(const SdfElement& element, SdfScope* scope) {
  for (const SdfElement& part : element.children()) {
    if (auto ok = add(part, scope); !ok) return ok;
  }
  return {};
}

void TreeReader::note_what_is_left_out() {
  for (const auto& [tag, names] : left_out_) {
    std::string text = std::to_string(names.size()) + " <" + tag + "> left out: ";
    for (std::size_t i = 0; i < std::min(names.size(), kUnreadShown); ++i) {
      text += (i == 0 ? "" : ", ") + names[i];
    }
    tree_.notices.push_back(text + (names.size() > kUnreadShown ? ", …" : ""));
  }
}

Expected<SdfTree> TreeReader::read(const SdfElement& world) {
  tree_.world = std::make_unique<SdfScope>();
  chain_.push_back(world.file().path());
  if (auto ok = fill(world, tree_.world.get()); !ok) return tl::unexpected(ok.error());
  if (auto ok = missing_.check("models"); !ok) return tl::unexpected(ok.error());
  note_what_is_left_out();
  return std::move(tree_);
}

}  // namespace

Expected<SdfTree> read_sdf_tree(const SdfElement& world, SdfIncludes& includes) {
  return TreeReader(includes).read(world);
}

}  // namespace canopeer
