#pragma once

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "canopeer/base/expected.h"

namespace canopeer {

/// A YAML value with the line it stands on.
struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMap };

  Kind kind = Kind::kNull;
  int line = 0;  ///< from 1; 0: not from the file
  std::string scalar;
  bool quoted = false;
  std::vector<std::unique_ptr<YamlNode>> items;
  std::vector<std::pair<std::string, std::unique_ptr<YamlNode>>> entries;
  std::set<std::string, std::less<>> asked;  ///< keys a reader has asked this mapping for
  bool visited = false;                      ///< a reader has this mapping

  [[nodiscard]] YamlNode* find(std::string_view key) const;
};

/// A YAML file as a tree, and what is wrong with it so far.
struct YamlDocument {
  /// Something that is wrong, and where.
  struct Complaint {
    bool missing = false;  ///< a key that is not there: an unknown key explains it better
    int line = 0;
    std::string message;  ///< complete, with file and line
  };

  std::string name;
  std::unique_ptr<YamlNode> root;
  std::vector<std::unique_ptr<YamlNode>> absent;  ///< stand-ins for mappings that are not there
  std::vector<Complaint> complaints;
  std::vector<std::pair<std::string, std::string>> used;  ///< dotted key, value in force as JSON

  [[nodiscard]] static Expected<std::shared_ptr<YamlDocument>> parse(std::string_view text,
                                                                     std::string name);
  [[nodiscard]] std::string place(const YamlNode& node) const;
  /// The complaint to show first, unknown keys of all visited mappings included; null: none.
  [[nodiscard]] std::unique_ptr<Complaint> first_complaint() const;
};

/// One YAML value from text, on line `line`.
[[nodiscard]] Expected<std::unique_ptr<YamlNode>> parse_yaml_value(std::string_view text,
                                                                   const std::string& name,
                                                                   bool keep_lines);

/// Of `known`, the name nearest to `name` by edit distance; empty when none is near.
[[nodiscard]] std::string nearest_name(std::string_view name,
                                       const std::set<std::string, std::less<>>& known);

}  // namespace canopeer
