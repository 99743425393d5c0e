#include "canopeer/import/sdf/sdf_state.h"

#include "canopeer/import/sdf/sdf_numbers.h"

namespace canopeer {
namespace {

Expected<SdfState::Entry> read_entry(const SdfElement& element) {
  SdfState::Entry entry;
  if (const SdfElement pose = element.child("pose")) {
    const auto T_world = sdf_pose(pose);
    if (!T_world) return tl::unexpected(T_world.error());
    entry.T_world = *T_world;
  }
  const auto scale = sdf_vector(element, "scale", Vec3::Ones());
  if (!scale) return tl::unexpected(scale.error());
  entry.scale = *scale;
  return entry;
}

Expected<void> read_model(const SdfElement& element, const std::string& scope, SdfState* state) {
  const std::string name = scope + element.name();
  auto model = read_entry(element);
  if (!model) return tl::unexpected(model.error());
  state->models[name] = std::move(*model);
  for (const SdfElement& link : element.children("link")) {
    auto entry = read_entry(link);
    if (!entry) return tl::unexpected(entry.error());
    state->links[name + "::" + link.name()] = std::move(*entry);
  }
  for (const SdfElement& nested : element.children("model")) {
    if (auto ok = read_model(nested, name + "::", state); !ok) return ok;
  }
  return {};
}

const SdfState::Entry* find(const std::map<std::string, SdfState::Entry>& entries,
                            const std::string& name) {
  const auto found = entries.find(name);
  return found == entries.end() ? nullptr : &found->second;
}

}  // namespace

const SdfState::Entry* SdfState::model(const std::string& name) const { return find(models, name); }

const SdfState::Entry* SdfState::link(const std::string& name) const { return find(links, name); }

Expected<SdfState> read_sdf_state(const SdfElement& world) {
  SdfState state;
  const SdfElement block = world.child("state");
  for (const SdfElement& model : block.children("model")) {
    if (auto ok = read_model(model, "", &state); !ok) return tl::unexpected(ok.error());
  }
  for (const SdfElement& deletions : block.children("deletions")) {
    for (const SdfElement& name : deletions.children("name")) state.deleted.insert(name.text());
  }
  state.insertions = block.children("insertions");
  return state;
}

}  // namespace canopeer
