#pragma once

#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/import/meshes/mesh_piece.h"

namespace canopeer {

/// Which parts of a world are what: regular expressions (ECMAScript, searched for anywhere in a
/// name, upper and lower case told apart). Empty: matches nothing; `counted`: every fruit.
struct NamePatternOptions {
  std::string fruit{};
  std::string counted{};  ///< of the fruits, the ones a run is scored on
  std::string leaf{};
  std::string stem{};
  std::string plant{};  ///< models that are plants even where nothing in them matches
  std::string skip{};   ///< parts that are left out
};

/// Tells classes by names. A piece has many names; the most specific one that matches any pattern
/// decides: material, texture, geometry, node, mesh file, visual, link, model. On one name fruit
/// comes before leaf before stem.
class NamePatterns {
 public:
  /// Error: which pattern is no regular expression, and why.
  [[nodiscard]] static Expected<NamePatterns> compile(const NamePatternOptions& options);

  /// fruit, leaf or stem; nothing when no name matches.
  [[nodiscard]] std::optional<PartClass> class_of(const PartNames& names) const;
  [[nodiscard]] bool counted(const PartNames& names) const;
  [[nodiscard]] bool plant(const PartNames& names) const;
  [[nodiscard]] bool skip(const PartNames& names) const;
  [[nodiscard]] const NamePatternOptions& options() const { return options_; }

 private:
  struct Compiled;
  NamePatternOptions options_;
  std::shared_ptr<const Compiled> compiled_;
};

/// From the most specific to the least, as messages and decisions go through them.
[[nodiscard]] std::vector<std::string> all_names(const PartNames& names);

}  // namespace canopeer
