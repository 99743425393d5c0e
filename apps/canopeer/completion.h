#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace canopeer::app {

/// What may stand where an argument names one of these.
struct CompletionNames {
  std::vector<std::string> missions;
  std::vector<std::string> planners;
  std::vector<std::string> sites;
  std::vector<std::string> compute_tables;
};

/// The line that says: files too.
inline constexpr const char* kFilesToo = ":files";

/// What may stand in place of the last of `words`, one candidate a line: the candidate or, where
/// something is known of it, candidate, tab, description; and kFilesToo. `words` stand behind the
/// program's name; the shell leaves out candidates that do not begin as the last word does. The
/// scripts for bash, zsh and fish in apps/canopeer/completion/ ask `canopeer complete WORD…`.
[[nodiscard]] std::vector<std::string> completions(const CLI::App& app,
                                                   const CompletionNames& names,
                                                   const std::vector<std::string>& words);

}  // namespace canopeer::app
