#pragma once

#include <cstdint>

#include "canopeer/render/camera_motion.h"
#include "canopeer/render/renderer.h"

namespace canopeer {

/// What a camera sees during a frame exposed around `t_s`, when `track` says where it really is; no
/// noise yet. Of sub-frames, no more than the image's motion asks for; one while it stands still,
/// the same as a view at rest.
///
/// Colour: the mean light of a row's sub-frames. Labels: those of its middle sub-frame. Depth: that
/// of the middle sub-frame where the row's sub-frames differ by no more than `edge_step` of their
/// depth. Else the pixel saw several surfaces: it shows one of them, the likelier the longer it was
/// seen, drawn by a hash of `key` and the pixel. No model of stereo under motion blur is known to
/// us; that edges in motion give torn depth is what Rodriguez, Zhang & Rajan, "Probabilistic
/// modeling of motion blur for time-of-flight sensors", Sensors 22(3), 2022, found of another kind
/// of camera. That texture smeared along the baseline matches worse is left out.
[[nodiscard]] RenderedView render_moving(const Renderer& renderer, const CameraRays& rays,
                                         const CameraTrack& track, double t_s,
                                         const CameraMotionOptions& motion, double edge_step,
                                         std::uint64_t key);

}  // namespace canopeer
