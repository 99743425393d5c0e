#pragma once

#include "canopeer/base/rng.h"
#include "canopeer/scene/fruit_truth.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// Base colours around the measured means, different for every leaf, shoot and fruit.
Rgb leaf_color(double below_tip_m, Rng& rng);
Rgb stem_color(Rng& rng);
Rgb calyx_color(Rng& rng);
Rgb fruit_color(Ripeness ripeness, Rng& rng);

/// `base` times a brightness near 1, each channel off by a little: what differs between two pieces
/// of the same kind. Spreads are shares of the value.
Rgb vary_color(Rgb base, double brightness_sd, double channel_sd, Rng& rng);

}  // namespace canopeer
