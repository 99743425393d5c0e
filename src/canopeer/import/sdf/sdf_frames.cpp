#include "canopeer/import/sdf/sdf_frames.h"

#include "canopeer/base/check.h"
#include "canopeer/import/sdf/sdf_file.h"
#include "canopeer/import/sdf/sdf_numbers.h"

namespace canopeer {
namespace {

constexpr std::size_t kMostInARow = 1000;  // places that hang on each other; bounds the stack
constexpr SdfVersion kFirstRelativeTo{1, 7};

/// T_base_place.
Expected<Pose> own_pose(const SdfPlace& place) {
  auto T = sdf_pose(place.pose);
  if (T) T->pretranslate(place.offset_m);
  return T;
}

std::string described(const SdfPlace& place) {
  const std::string name = place.owner.name();
  return place.owner.where() + ": <" + std::string(place.owner.tag()) + ">" +
         (name.empty() ? "" : " '" + name + "'");
}

bool is_scope_itself(const SdfScope& scope, std::string_view name) {
  return name.empty() || name == "__model__" || name == "__root__" ||
         (name == "world" && scope.parent == nullptr);
}

}  // namespace

std::string SdfPlace::relative_to() const {
  if (!pose) return base;
  auto name = pose.attribute("relative_to");
  if (!name && pose.file().version() < kFirstRelativeTo) name = pose.attribute("frame");
  return name && !name->empty() ? *name : base;
}

/// In what a scope holds, merged models included.
std::optional<SdfFrames::Target> SdfFrames::find(const SdfScope& scope, std::string_view name) {
  if (is_scope_itself(scope, name)) return Target{&scope, nullptr};
  const std::string key(name);
  if (const auto frame = scope.frames.find(key); frame != scope.frames.end()) {
    return Target{&scope, &frame->second};
  }
  if (const auto model = scope.models.find(key); model != scope.models.end()) {
    return Target{model->second, nullptr};
  }
  for (const SdfPart& part : scope.parts) {
    if (!part.model || !part.model->merged) continue;
    // The name that a merged model's own frame has where it went.
    if (name == "_merged__" + part.model->name + "__model__")
      return Target{part.model.get(), nullptr};
    if (auto target = find(*part.model, name)) return target;
  }
  return find_below(scope, name);
}

/// "model::…", of which a model's name may hold a "::" itself.
std::optional<SdfFrames::Target> SdfFrames::find_below(const SdfScope& scope,
                                                       std::string_view name) {
  for (std::size_t at = name.find("::"); at != std::string_view::npos;
       at = name.find("::", at + 2)) {
    const auto model = scope.models.find(std::string(name.substr(0, at)));
    if (model == scope.models.end()) continue;
    if (auto target = find(*model->second, name.substr(at + 2))) return target;
  }
  return std::nullopt;
}

template <typename Resolve>
Expected<Pose> SdfFrames::once(const SdfPlace& place, Resolve resolve) {
  const auto [known, fresh] = known_.emplace(&place, std::nullopt);
  if (known->second) return *known->second;
  if (!fresh) {
    return fail(described(place) + ": its pose cannot be resolved: it is relative to itself");
  }
  if (depth_ == kMostInARow) {
    return fail(described(place) + ": its pose cannot be resolved: more than " +
                std::to_string(kMostInARow) + " others hang on each other");
  }
  ++depth_;
  Expected<Pose> T = resolve();
  --depth_;
  if (!T) return T;
  if (!T->matrix().allFinite()) return fail(described(place) + ": its pose is not finite");
  known_[&place] = *T;
  return T;
}

/// T_scope_name.
Expected<Pose> SdfFrames::named(const SdfScope& scope, const std::string& name,
                                const SdfPlace& asks) {
  const auto target = find(scope, name);
  if (!target) {
    return fail(described(asks) + ": its pose cannot be resolved: '" + name +
                "' is no link, joint, frame or model of " +
                (scope.parent == nullptr ? "the world" : "model '" + scope.name + "'"));
  }
  Expected<Pose> T = Pose(Pose::Identity());
  if (target->place != nullptr) T = place(*target->scope, *target->place);
  for (const SdfScope* at = target->scope; T && at != &scope; at = at->parent) {
    const auto T_parent_at = model(*at);
    if (!T_parent_at) return T_parent_at;
    T = *T_parent_at * *T;
  }
  return T;
}

/// T_scope_place.
Expected<Pose> SdfFrames::place(const SdfScope& scope, const SdfPlace& place) {
  return once(place, [&]() -> Expected<Pose> {
    const auto T_scope_base = named(scope, place.relative_to(), place);
    if (!T_scope_base) return T_scope_base;
    const auto T_base_place = own_pose(place);
    if (!T_base_place) return T_base_place;
    return *T_scope_base * *T_base_place;
  });
}

Expected<Pose> SdfFrames::model(const SdfScope& model) {
  if (model.parent == nullptr) return Pose(Pose::Identity());
  return once(model.place, [&]() -> Expected<Pose> {
    const auto T_parent_base = named(*model.parent, model.place.relative_to(), model.place);
    if (!T_parent_base) return T_parent_base;
    const auto T_base_placed = own_pose(model.place);
    if (!T_base_placed) return T_base_placed;
    const auto T_model_placed = named(model, model.placement_frame, model.place);
    if (!T_model_placed) return T_model_placed;
    return *T_parent_base * *T_base_placed * T_model_placed->inverse();
  });
}

Expected<Pose> SdfFrames::frame(const SdfScope& model, const std::string& name) {
  const auto found = model.frames.find(name);
  CANOPEER_CHECK(found != model.frames.end(), "a link is a frame of its model");
  return place(model, found->second);
}

Expected<Pose> SdfFrames::in_link(const SdfScope& model, const std::string& link,
                                  const SdfPlace& part) {
  const std::string base = part.relative_to();
  const auto T_base_part = sdf_pose(part.pose);
  if (!T_base_part || base.empty()) return T_base_part;
  const auto T_model_base = named(model, base, part);
  if (!T_model_base) return T_model_base;
  const auto T_model_link = frame(model, link);
  if (!T_model_link) return T_model_link;
  return T_model_link->inverse() * *T_model_base * *T_base_part;
}

}  // namespace canopeer
