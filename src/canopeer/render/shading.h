#pragma once

#include "canopeer/render/ray_caster.h"
#include "canopeer/render/surface_soup.h"

namespace canopeer {

/// Light of a rendering.
struct Light {
  Eigen::Vector3f direction;  ///< unit vector towards it, world
  float ambient = 0.6F;       ///< share that comes from everywhere
};

/// Colour (0 … 255, may exceed it) of a hit seen along `ray`. Both sides of a surface are lit;
/// leaves let some light through; fruits are glossy. `shadowed` takes the direct light away.
Eigen::Vector3f shade(const SurfaceSoup& soup, const RayCaster::Hit& hit, const RayCaster::Ray& ray,
                      const Light& light, bool shadowed);

/// Seen where no surface is: a bright overcast sky, paler towards the horizon.
Eigen::Vector3f sky_color(const Eigen::Vector3f& direction);

}  // namespace canopeer
