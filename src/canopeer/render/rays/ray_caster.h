#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "canopeer/render/surfaces/surface_soup.h"

namespace canopeer {

/// Nearest intersections of rays with triangles, through the holes that textures cut; Embree behind
/// it. Models that stand in many places are kept once.
class RayCaster {
 public:
  struct Ray {
    Eigen::Vector3f origin;
    Eigen::Vector3f direction;  ///< any length; distances are in units of it
  };
  struct Hit {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t triangle = kNone;  ///< in the world's soup, or in that of the instance's model
    std::uint32_t instance = kNone;  ///< kNone: the world itself
    float distance = 0.0F;
    float u = 0.0F;  ///< weight of the triangle's second vertex
    float v = 0.0F;  ///< and of its third
  };
  /// Rays a call takes at most.
  static constexpr std::size_t kPacket = 64;

  /// A model in its place.
  struct Placement {
    std::size_t model = 0;
    Pose T_world_model = Pose::Identity();
  };

  /// All soups outlive the caster when they have triangles with holes.
  explicit RayCaster(const SurfaceSoup& world, const std::vector<SurfaceSoup>& models = {},
                     const std::vector<Placement>& instances = {});
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// hits[i] for rays[i]; quick when they are neighbours in the image. Thread-safe.
  void closest(std::span<const Ray> rays, std::span<Hit> hits) const;

  /// blocked[i] says whether anything lies on rays[i] beyond `from` (in its units). Thread-safe.
  void occluded(std::span<const Ray> rays, float from, std::span<bool> blocked) const;

  /// The same for what lies between each ray's origin and the end of its direction. Thread-safe.
  void blocked_between(std::span<const Ray> rays, std::span<bool> blocked) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace canopeer
