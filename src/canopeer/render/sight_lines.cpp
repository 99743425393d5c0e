#include "canopeer/render/sight_lines.h"

#include "canopeer/render/rays/ray_caster.h"

namespace canopeer {
namespace {

constexpr double kLastPieceM = 0.0005;

SurfaceSoup soup_of(const std::vector<NumberedPart>& numbered) {
  std::vector<ScenePart> parts;
  parts.reserve(numbered.size());
  for (const NumberedPart& p : numbered) parts.push_back(p.part);
  return make_surface_soup(parts);
}

}  // namespace

struct SightLines::Impl {
  explicit Impl(const std::vector<NumberedPart>& parts) : soup(soup_of(parts)), caster(soup) {}

  SurfaceSoup soup;
  RayCaster caster;
};

SightLines::SightLines(const std::vector<NumberedPart>& parts)
    : impl_(std::make_unique<Impl>(parts)) {}
SightLines::~SightLines() = default;
SightLines::SightLines(SightLines&&) noexcept = default;
SightLines& SightLines::operator=(SightLines&&) noexcept = default;

bool SightLines::clear(const Vec3& from, const Vec3& to_surface) const {
  const Vec3 way = to_surface - from;
  const double length_m = way.norm();
  if (length_m <= kLastPieceM) return true;
  const RayCaster::Ray ray{from.cast<float>(),
                           (way * (1.0 - kLastPieceM / length_m)).cast<float>()};
  bool blocked = false;
  impl_->caster.blocked_between({&ray, 1}, {&blocked, 1});
  return !blocked;
}

}  // namespace canopeer
