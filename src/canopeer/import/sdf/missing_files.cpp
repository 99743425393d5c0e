#include "canopeer/import/sdf/missing_files.h"

namespace canopeer {

void MissingFiles::add(const std::string& uri, const Error& error) {
  if (uris_.empty()) first_ = error;
  uris_.insert(uri);
}

Expected<void> MissingFiles::check(const char* what) const {
  if (uris_.empty()) return {};
  std::string text = first_.message;
  if (uris_.size() > 1) {
    text += "; missing in all: " + std::to_string(uris_.size()) + " " + what + ":";
    for (const std::string& uri : uris_) text += " " + uri;
  }
  return fail(text);
}

}  // namespace canopeer
