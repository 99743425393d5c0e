#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/dds/node.h"

// What ROS 2 says to its programs: `--ros-args -r /a:=/b -p rate:=5.0 … --`
// (docs.ros.org, "Passing ROS arguments to nodes via the command-line").

namespace canopeer::ros {

/// What stands behind `--ros-args`.
struct RosArguments {
  /// `-r from:=to`, or of one node only: `-r node:from:=to`.
  struct Remap {
    std::string node;  ///< empty: of any
    std::string from;
    std::string to;
  };
  /// `-p name:=value`, or of one node only: `-p node:name:=value`. The value is YAML.
  struct Setting {
    std::string node;
    std::string name;
    std::string value;
  };

  std::optional<std::string> node;  ///< `-r __node:=n`
  std::optional<std::string> ns;    ///< `-r __ns:=/x`
  std::vector<Remap> remaps;
  std::vector<Setting> settings;
  std::vector<std::string> parameter_files;  ///< `--params-file FILE`, in the order given
  std::optional<std::string> log_level;      ///< `--log-level info`, in lower case
  std::vector<std::string> rest;             ///< what is not for ROS, in its order

  /// Takes what stands between `--ros-args` and `--`, or the end. The error names the argument.
  [[nodiscard]] static Expected<RosArguments> parse(const std::vector<std::string>& arguments);

  /// Name, namespace and remappings put over those of `options`.
  void apply(NodeOptions& options) const;
  /// Values set for the node of that name, the last one of each counts.
  [[nodiscard]] std::map<std::string, std::string> settings_of(const std::string& node_name) const;
};

/// The text of ROS_DOMAIN_ID: 0 … 232, none when empty.
[[nodiscard]] Expected<std::optional<int>> domain_from(const std::string& text);

}  // namespace canopeer::ros
