#pragma once

#include <string>

#include "commands.h"

namespace CLI {
class App;
}

namespace canopeer::app {

inline constexpr const char* kExitStatusText =
    "0 done, 1 the run failed, 2 bad usage or input, 130 interrupted.";

/// A manual page in the language of man(7): of the program where `command` is `app` itself, else of
/// one of its commands with all that it has below. Everything in it comes from what the command
/// line accepts, so it cannot say otherwise than --help.
[[nodiscard]] std::string manual_page(const CLI::App& app, const CLI::App& command);

/// Prints the page asked for, or writes all of them.
void manual(const CLI::App& app, const ManualArguments& arguments);

}  // namespace canopeer::app
