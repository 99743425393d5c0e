#pragma once

#include <set>
#include <string>

#include "canopeer/base/expected.h"

namespace canopeer {

/// What a world refers to and is not there: all of it is said at once.
class MissingFiles {
 public:
  /// `error` says of the first where it is referred to and what to do.
  void add(const std::string& uri, const Error& error);
  [[nodiscard]] bool empty() const { return uris_.empty(); }
  /// The error of the first, with the addresses of all when there are more. `what`: "models".
  [[nodiscard]] Expected<void> check(const char* what) const;

 private:
  std::set<std::string> uris_;
  Error first_;
};

}  // namespace canopeer
