#pragma once

#include "canopeer/scene/scene.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// One picture of the whole scene for people. It is seen from outside and above one end of the
/// aisle, all plants in view, with shadows and smooth edges. The camera follows from the scene's
/// bounds.
ColorImage render_overview(const Scene& scene, int width, int height);

}  // namespace canopeer
