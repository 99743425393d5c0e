#include "completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "command_tree.h"

namespace canopeer::app {
namespace {

using Lines = std::vector<std::string>;

/// "m", "cm", "mm" of "TEXT:{m,cm,mm}"; nothing where no list is given.
Lines listed_values(const std::string& type) {
  const auto begin = type.find('{');
  const auto end = type.find('}');
  Lines values;
  if (begin == std::string::npos || end == std::string::npos) return values;
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string value; std::getline(list, value, ',');) values.push_back(value);
  return values;
}

/// "vmp,ra" may become "vmp,random": each of `names` behind what stands before the last comma.
Lines behind_comma(const Lines& names, const std::string& word) {
  const std::string kept = word.substr(0, word.rfind(',') + 1);
  Lines lists;
  for (const std::string& name : names) lists.push_back(kept + name);
  return lists;
}

Lines with_files(Lines lines) {
  lines.emplace_back(kFilesToo);
  return lines;
}

Lines values_of(const CLI::Option& option, const CompletionNames& names, const std::string& word) {
  const std::string name = option.get_single_name();
  if (name == "mission" || name == "missions") return with_files(names.missions);
  if (name == "planner") return names.planners;
  if (name == "planners") return behind_comma(names.planners, word);
  if (name == "site") return names.sites;
  if (name == "compute-table") return with_files(names.compute_tables);
  const std::string type = option.get_type_name();
  if (Lines listed = listed_values(type); !listed.empty()) return listed;
  return type.rfind("TEXT", 0) == 0 && name != "set" ? Lines{kFilesToo} : Lines{};
}

void append(Lines& lines, const Lines& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

Lines options_of(const CLI::App& command) {
  Lines lines;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional() || option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) {
      lines.push_back("--" + name + '\t' + option->get_description());
    }
  }
  return lines;
}

Lines commands_of(const CLI::App& command) {
  Lines lines;
  for (const CLI::App* sub : subcommands(command)) {
    lines.push_back(sub->get_name() + '\t' + sub->get_description());
  }
  return lines;
}

const CLI::App* subcommand(const CLI::App& command, const std::string& name) {
  const auto all = subcommands(command);
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const CLI::App* sub) { return sub->get_name() == name; });
  return found == all.end() ? nullptr : *found;
}

/// The `place`-th argument without a name; the last one where it takes many.
const CLI::Option* positional(const CLI::App& command, int place) {
  const CLI::Option* last = nullptr;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    last = option;
    if (place-- == 0) return option;
  }
  return last != nullptr && last->get_items_expected_max() > 1 ? last : nullptr;
}

}  // namespace

Lines completions(const CLI::App& app, const CompletionNames& names, const Lines& words) {
  const CLI::App* command = &app;
  const CLI::Option* awaiting = nullptr;  // the option whose value comes next
  int place = 0;                          // of the next argument without a name
  const std::string last = words.empty() ? "" : words.back();
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "=") continue;  // bash cuts --site=x into three
    if (awaiting != nullptr) {
      awaiting = nullptr;
    } else if (word.rfind("-", 0) == 0) {
      const CLI::Option* option = command->get_option_no_throw(word);
      if (option != nullptr && takes_value(*option)) awaiting = option;
    } else if (const CLI::App* sub = subcommand(*command, word); sub != nullptr) {
      command = sub;
      place = 0;
    } else {
      ++place;
    }
  }
  if (awaiting != nullptr) return values_of(*awaiting, names, last == "=" ? "" : last);
  if (last.rfind("-", 0) == 0) return options_of(*command);
  Lines lines = commands_of(*command);
  if (const CLI::Option* argument = positional(*command, place); argument != nullptr) {
    append(lines,
           command->get_name() == "manual" ? commands_of(app) : values_of(*argument, names, last));
  }
  return lines;
}

}  // namespace canopeer::app
