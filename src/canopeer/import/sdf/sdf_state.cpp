#include "canopeer/import/sdf/sdf_state.h"

#include <sdf/Element.hh>
#include <sdf/World.hh>

#include "canopeer/import/sdf/sdf_convert.h"

namespace canopeer {
namespace {

SdfState::Entry read_entry(const sdf::ElementPtr& element) {
  SdfState::Entry entry;
  if (element->HasElement("pose")) {
    entry.T_world = to_pose(element->GetElement("pose")->Get<ignition::math::Pose3d>());
  }
  if (element->HasElement("scale")) {
    entry.scale = to_vec3(element->GetElement("scale")->Get<ignition::math::Vector3d>());
  }
  return entry;
}

template <typename Visit>
void for_each(const sdf::ElementPtr& parent, const std::string& tag, Visit visit) {
  if (!parent->HasElement(tag)) return;
  for (auto e = parent->GetElement(tag); e; e = e->GetNextElement(tag)) visit(e);
}

void read_model(const sdf::ElementPtr& element, const std::string& scope, SdfState* state) {
  const std::string name = scope + element->Get<std::string>("name");
  state->models[name] = read_entry(element);
  for_each(element, "link", [&](const sdf::ElementPtr& link) {
    state->links[name + "::" + link->Get<std::string>("name")] = read_entry(link);
  });
  for_each(element, "model",
           [&](const sdf::ElementPtr& nested) { read_model(nested, name + "::", state); });
}

const SdfState::Entry* find(const std::map<std::string, SdfState::Entry>& entries,
                            const std::string& name) {
  const auto found = entries.find(name);
  return found == entries.end() ? nullptr : &found->second;
}

}  // namespace

const SdfState::Entry* SdfState::model(const std::string& name) const { return find(models, name); }

const SdfState::Entry* SdfState::link(const std::string& name) const { return find(links, name); }

SdfState read_sdf_state(const sdf::World& world) {
  SdfState state;
  const sdf::ElementPtr element = world.Element();
  if (!element || !element->HasElement("state")) return state;
  const sdf::ElementPtr block = element->GetElement("state");
  for_each(block, "model", [&](const sdf::ElementPtr& model) { read_model(model, "", &state); });
  for_each(block, "deletions", [&](const sdf::ElementPtr& deletions) {
    for_each(deletions, "name",
             [&](const sdf::ElementPtr& name) { state.deleted.insert(name->Get<std::string>()); });
  });
  for_each(block, "insertions", [&](const sdf::ElementPtr& insertions) {
    for_each(insertions, "model",
             [&](const sdf::ElementPtr& model) { state.insertions += model->ToString(""); });
  });
  return state;
}

}  // namespace canopeer
