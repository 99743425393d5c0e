#pragma once

#include <filesystem>

#include "canopeer/base/expected.h"

namespace canopeer {

/// The folder of a run that comes into being under another name, `DIR.RANDOM.part`, and gets its
/// own when it is whole. Each object has a name of its own: of several processes that make the same
/// run at the same time, on one machine or on several with a shared folder, none writes into
/// another's.
class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path dir);

  [[nodiscard]] const std::filesystem::path& dir() const { return dir_; }
  /// What is under way is written here.
  [[nodiscard]] const std::filesystem::path& part() const { return part_; }

  /// Makes the folder `part`, empty.
  [[nodiscard]] Expected<void> begin() const;
  /// Renames `part` to `dir`, and removes what others have left of the same run. Error: it cannot
  /// be renamed; when another process was first, for instance.
  [[nodiscard]] Expected<void> finish() const;
  /// Renames `part` to `DIR.part`, for people: the rest of a run that failed.
  void leave() const;
  /// Removes `part`.
  void drop() const;

 private:
  std::filesystem::path dir_;
  std::filesystem::path part_;
};

}  // namespace canopeer
