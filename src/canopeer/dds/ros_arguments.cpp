#include "canopeer/dds/ros_arguments.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "canopeer/dds/names.h"

namespace canopeer::ros {
namespace {

constexpr int kLargestDomain = 232;

/// "node:left:=right", the node's name optional.
struct Rule {
  std::string node;
  std::string left;
  std::string right;
};

Expected<Rule> rule_in(const std::string& text) {
  const std::size_t middle = text.find(":=");
  if (middle == std::string::npos || middle == 0) {
    return fail("'" + text + "' is not like 'from:=to'");
  }
  Rule rule{"", text.substr(0, middle), text.substr(middle + 2)};
  const std::size_t colon = rule.left.find(':');
  // "rostopic://a" and "rosservice://a" have a colon of their own.
  if (colon != std::string::npos && rule.left.compare(colon, 3, "://") != 0) {
    rule.node = rule.left.substr(0, colon);
    rule.left.erase(0, colon + 1);
    if (const auto sound = check_node_name(rule.node); !sound) {
      return tl::unexpected(sound.error());
    }
  }
  for (const char* scheme : {"rostopic://", "rosservice://"}) {
    if (rule.left.starts_with(scheme)) rule.left.erase(0, std::string(scheme).size());
  }
  if (rule.left.empty()) return fail("'" + text + "' is not like 'from:=to'");
  return rule;
}

Expected<void> add_remap(RosArguments& to, const std::string& text) {
  const auto rule = rule_in(text);
  if (!rule) return tl::unexpected(rule.error());
  if (rule->left == "__node" || rule->left == "__name") {
    to.node = rule->right;
    return check_node_name(rule->right);
  }
  if (rule->left == "__ns") {
    to.ns = rule->right;
    return check_namespace(rule->right);
  }
  const NodeName any{"/", "any"};
  for (const std::string& side : {rule->left, rule->right}) {
    if (const auto name = expand_name(side, any); !name) return tl::unexpected(name.error());
  }
  to.remaps.push_back({rule->node, rule->left, rule->right});
  return {};
}

Expected<void> add_setting(RosArguments& to, const std::string& text) {
  const auto rule = rule_in(text);
  if (!rule) return tl::unexpected(rule.error());
  to.settings.push_back({rule->node, rule->left, rule->right});
  return {};
}

Expected<void> set_log_level(RosArguments& to, std::string level) {
  // "logger:=level" of one logger among others: there is only one here.
  const std::size_t middle = level.find(":=");
  if (middle != std::string::npos) level.erase(0, middle + 2);
  std::transform(level.begin(), level.end(), level.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* known : {"debug", "info", "warn", "error", "fatal"}) {
    if (level == known) {
      to.log_level = level;
      return {};
    }
  }
  return fail("'" + level + "' is none of debug, info, warn, error, fatal");
}

/// Takes an option's value; nothing: there is no such option.
using Take = Expected<void> (*)(RosArguments&, const std::string&);
Take taker_of(const std::string& option) {
  if (option == "-r" || option == "--remap") return add_remap;
  if (option == "-p" || option == "--param") return add_setting;
  if (option == "--params-file") {
    return [](RosArguments& to, const std::string& file) -> Expected<void> {
      to.parameter_files.push_back(file);
      return {};
    };
  }
  if (option == "--log-level") {
    return [](RosArguments& to, const std::string& level) { return set_log_level(to, level); };
  }
  return nullptr;
}

/// Switches of ROS's own logging and security: heard and without effect here.
bool has_no_effect(const std::string& option) {
  for (const char* ending : {"rosout-logs", "stdout-logs", "external-lib-logs"}) {
    if (option == std::string("--enable-") + ending) return true;
    if (option == std::string("--disable-") + ending) return true;
  }
  return false;
}
bool has_no_effect_but_a_value(const std::string& option) {
  return option == "--log-config-file" || option == "--log-file-name" || option == "-e" ||
         option == "--enclave";
}

}  // namespace

Expected<RosArguments> RosArguments::parse(const std::vector<std::string>& arguments) {
  RosArguments parsed;
  bool for_ros = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& option = arguments[i];
    if (!for_ros) {
      for_ros = option == "--ros-args";
      if (!for_ros) parsed.rest.push_back(option);
      continue;
    }
    if (option == "--") {
      for_ros = false;
      continue;
    }
    if (option == "--ros-args" || has_no_effect(option)) continue;
    const Take take = taker_of(option);
    if (take == nullptr && !has_no_effect_but_a_value(option)) {
      return fail("--ros-args: '" + option +
                  "' is unknown; known are -r, -p, --params-file, "
                  "--log-level and '--' at the end");
    }
    if (++i == arguments.size()) return fail("--ros-args: " + option + " needs a value");
    if (take == nullptr) continue;
    const auto taken = take(parsed, arguments[i]);
    if (!taken) return fail_in("--ros-args " + option, taken.error());
  }
  return parsed;
}

void RosArguments::apply(NodeOptions& options) const {
  if (node) options.name = *node;
  if (ns) options.ns = *ns;
  for (const Remap& remap : remaps) {
    if (remap.node.empty() || remap.node == options.name) options.remaps[remap.from] = remap.to;
  }
}

std::map<std::string, std::string> RosArguments::settings_of(const std::string& node_name) const {
  std::map<std::string, std::string> values;
  for (const Setting& setting : settings) {
    if (setting.node.empty() || setting.node == node_name) values[setting.name] = setting.value;
  }
  return values;
}

Expected<std::optional<int>> domain_from(const std::string& text) {
  if (text.empty()) return std::optional<int>{};
  int domain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error != std::errc{} || end != text.data() + text.size() || domain < 0 ||
      domain > kLargestDomain) {
    return fail("ROS_DOMAIN_ID is '" + text + "', must be 0 … 232");
  }
  return std::optional<int>{domain};
}

}  // namespace canopeer::ros
