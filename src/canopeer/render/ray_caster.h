#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "canopeer/render/surface_soup.h"

namespace canopeer {

/// Nearest intersections of rays with triangles, through the holes that textures cut; Embree behind
/// it.
class RayCaster {
 public:
  struct Ray {
    Eigen::Vector3f origin;
    Eigen::Vector3f direction;  ///< any length; distances are in units of it
  };
  struct Hit {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t triangle = kNone;
    float distance = 0.0F;
    float u = 0.0F;  ///< weight of the triangle's second vertex
    float v = 0.0F;  ///< and of its third
  };
  /// Rays a call takes at most.
  static constexpr std::size_t kPacket = 64;

  /// `soup` outlives the caster when it has triangles with holes.
  explicit RayCaster(const SurfaceSoup& soup);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// hits[i] for rays[i]; quick when they are neighbours in the image. Thread-safe.
  void closest(std::span<const Ray> rays, std::span<Hit> hits) const;

  /// blocked[i] says whether anything lies on rays[i] beyond `from` (in its units). Thread-safe.
  void occluded(std::span<const Ray> rays, float from, std::span<bool> blocked) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace canopeer
