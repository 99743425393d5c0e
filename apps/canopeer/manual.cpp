#include "manual.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "canopeer/base/atomic_file.h"
#include "command_tree.h"
#include "exit_status.h"

namespace canopeer::app {
namespace {

/// Text that is no request and has no ligatures: dashes and backslashes as typed.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out.rfind('.', 0) == 0 || out.rfind('\'', 0) == 0 ? "\\&" + out : out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }
std::string heading(const std::string& text) { return ".SH " + text + "\n"; }
std::string item(const std::string& term, const std::string& text) {
  return ".TP\n" + term + "\n" + text + "\n";
}

/// "canopeer scene render", from `app` down.
std::string full_name(const CLI::App& app, const CLI::App& command) {
  if (&command == &app) return "canopeer";
  return full_name(app, *command.get_parent()) + ' ' + command.get_name();
}

std::string page_name(const CLI::App& app, const CLI::App& command) {
  return &command == &app ? "canopeer" : "canopeer-" + command.get_name();
}

std::string usage(const CLI::App& app, const CLI::App& command) {
  std::string text = bold(full_name(app, command));
  if (!subcommands(command).empty()) return text + ' ' + italic("COMMAND") + " ...\n";
  text += " [" + italic("OPTION") + "]...";
  for (const CLI::Option* option : command.get_options()) {
    const bool many = option->get_items_expected_max() > 1;
    const std::string name = italic(option->get_single_name()) + (many ? "..." : "");
    if (option->get_positional()) {
      text += option->get_required() ? ' ' + name : " [" + name + ']';
    } else if (option->get_required()) {
      text += ' ' + bold("--" + option->get_single_name()) + ' ' + italic(option->get_type_name());
    }
  }
  return text + '\n';
}

/// "--seed UINT", "-h, --help", "mission".
std::string term(const CLI::Option& option) {
  if (option.get_positional()) return italic(option.get_single_name());
  std::string names;
  const auto add = [&](const std::string& name) {
    names += (names.empty() ? "" : ", ") + bold(name);
  };
  for (const std::string& name : option.get_snames()) add('-' + name);
  for (const std::string& name : option.get_lnames()) add("--" + name);
  return takes_value(option) ? names + ' ' + italic(option.get_type_name()) : names;
}

std::string arguments(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    const std::string standard = option->get_default_str();
    text += item(term(*option), roff(option->get_description()) +
                                    (standard.empty() ? "" : " (default: " + roff(standard) + ')'));
  }
  return text;
}

std::string commands_section(const CLI::App& app, const CLI::App& command) {
  std::string text = heading("COMMANDS");
  for (const CLI::App* sub : subcommands(command)) {
    if (&command == &app) {
      text += item(bold(sub->get_name()), roff(sub->get_description()));
    } else {
      text += ".SS " + roff(full_name(app, *sub)) + '\n' + roff(sub->get_description()) +
              "\n.PP\n" + usage(app, *sub) + arguments(*sub);
    }
  }
  return text;
}

std::string surroundings_section() {
  return heading("ENVIRONMENT") +
         item(bold("CANOPEER_DATA"),
              "Folder of the shipped missions, robots, worlds and compute "
              "tables, in place of the installed one.") +
         item(bold("XDG_DATA_HOME"), "Where the table of " + bold("canopeer calibrate") +
                                         " lies, as canopeer/compute_tables/this\\-machine.yaml. "
                                         "Default: ~/.local/share.") +
         heading("FILES") +
         item(italic("PREFIX/share/canopeer/"), "What CANOPEER_DATA may replace.");
}

std::string see_also_section(const CLI::App& app, const CLI::App& command) {
  std::string text;
  const auto add = [&](const CLI::App& other) {
    if (&other == &command) return;
    text += (text.empty() ? "" : ",\n") + (".BR " + roff(page_name(app, other))) + " (1)";
  };
  add(app);
  if (&command == &app) {
    for (const CLI::App* sub : subcommands(app)) add(*sub);
  }
  return heading("SEE ALSO") + text + '\n';
}

}  // namespace

std::string manual_page(const CLI::App& app, const CLI::App& command) {
  const std::string name = page_name(app, command);
  std::string text = ".TH " + roff(upper(name)) + " 1 \"\" \"canopeer " + CANOPEER_VERSION +
                     "\" \"Canopeer\"\n.nh\n.ad l\n";
  text += heading("NAME") + roff(name) + " \\- " + roff(command.get_description()) + '\n';
  text += heading("SYNOPSIS") + usage(app, command);
  if (const std::string options = arguments(command); !options.empty()) {
    text += heading("OPTIONS") + options;
  }
  if (!subcommands(command).empty()) text += commands_section(app, command);
  text += heading("EXIT STATUS") + roff(kExitStatusText) + '\n';
  return text + surroundings_section() + see_also_section(app, command);
}

void manual(const CLI::App& app, const ManualArguments& arguments) {
  std::vector<const CLI::App*> pages = {&app};
  for (const CLI::App* sub : subcommands(app)) pages.push_back(sub);
  if (!arguments.folder.empty()) {
    const std::filesystem::path folder = std::filesystem::path(arguments.folder) / "man1";
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (code) stop_with(kFailed, {folder.string() + ": cannot be made: " + code.message()});
    for (const CLI::App* page : pages) {
      value_or_stop(write_file(folder / (page_name(app, *page) + ".1"), manual_page(app, *page)),
                    kFailed);
    }
    return;
  }
  for (const CLI::App* page : pages) {
    if (arguments.command != (page == &app ? "" : page->get_name())) continue;
    std::fputs(manual_page(app, *page).c_str(), stdout);
    return;
  }
  stop_with(kBadInput, {"manual: there is no command '" + arguments.command + "'"});
}

}  // namespace canopeer::app
