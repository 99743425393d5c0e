#pragma once

#include <memory>
#include <vector>

#include "canopeer/geometry/pose.h"
#include "canopeer/render/numbered_view.h"

namespace canopeer {

/// Whether points see each other past these parts; see-through ones do not count.
class SightLines {
 public:
  explicit SightLines(const std::vector<NumberedPart>& parts);
  ~SightLines();
  SightLines(SightLines&&) noexcept;
  SightLines& operator=(SightLines&&) noexcept;

  /// Nothing lies between a point in space and one on a surface; the last half millimetre does not
  /// count. World frame, metres. Thread-safe.
  [[nodiscard]] bool clear(const Vec3& from, const Vec3& to_surface) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace canopeer
