#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/scene/scene_file.h"

namespace canopeer {

/// The scene as its file will give it, with the ground truth of what it then shows: centres,
/// volumes and surfaces are measured anew on the meshes that lie on the file's grid, on their
/// convex hulls in imported scenes. Lengths and diameters of generated fruits stay those they were
/// grown to. Writing it and reading it again changes nothing but packed normals. Error: as
/// scene_bytes().
[[nodiscard]] Expected<Scene> frozen_scene(const Scene& scene,
                                           const SceneFileOptions& options = {});

}  // namespace canopeer
