#pragma once

#include <CLI/CLI.hpp>
#include <vector>

namespace canopeer::app {

inline std::vector<const CLI::App*> subcommands(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

inline bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

}  // namespace canopeer::app
