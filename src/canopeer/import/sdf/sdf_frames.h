#pragma once

#include <map>
#include <optional>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/geometry/pose.h"
#include "canopeer/import/sdf/sdf_scope.h"

namespace canopeer {

/// Where everything lies in a world, resolved as SDF says: `relative_to`, `attached_to`,
/// `placement_frame`, names like "row::plant::link". Each place is resolved once. Errors name file
/// and line: a name that is nowhere, a pose relative to itself.
class SdfFrames {
 public:
  /// A model in its parent: T_parent_model.
  [[nodiscard]] Expected<Pose> model(const SdfScope& model);
  /// A link, frame or joint in its model: T_model_frame.
  [[nodiscard]] Expected<Pose> frame(const SdfScope& model, const std::string& name);
  /// What lies in a link, with its own <pose>: T_link_part.
  [[nodiscard]] Expected<Pose> in_link(const SdfScope& model, const std::string& link,
                                       const SdfPlace& part);

 private:
  /// Something with a name, seen from some scope.
  struct Target {
    const SdfScope* scope;
    const SdfPlace* place;  ///< null: the scope itself
  };
  static std::optional<Target> find(const SdfScope& scope, std::string_view name);
  static std::optional<Target> find_below(const SdfScope& scope, std::string_view name);

  Expected<Pose> named(const SdfScope& scope, const std::string& name, const SdfPlace& asks);
  Expected<Pose> place(const SdfScope& scope, const SdfPlace& place);
  /// Runs `resolve` unless its answer is known, or being looked for.
  template <typename Resolve>
  Expected<Pose> once(const SdfPlace& place, Resolve resolve);

  std::map<const SdfPlace*, std::optional<Pose>> known_;  ///< nothing: being resolved
  std::size_t depth_ = 0;
};

}  // namespace canopeer
