// Fuses frames into a map and asks the map. The frames are rendered here; yours come from a camera:
// fill an RgbdFrame with depth, colour, intrinsics and pose, the rest is the same.
//   01_fuse_frames [MAP.cmap]

#include <cstdio>

#include "canopeer/detect/color_detector.h"
#include "canopeer/map/frontier.h"
#include "canopeer/map/fusion.h"
#include "canopeer/map/map_file.h"
#include "canopeer/map/view_cast.h"
#include "canopeer/render/renderer.h"
#include "canopeer/scene/worlds.h"

using namespace canopeer;

int main(int argc, char** argv) {
  const Renderer glasshouse(make_world(scenario_1_world(), 1));
  const ColorDetector detector{ColorDetectorOptions()};
  VoxelMap map;  // voxels of 1 cm

  // The camera goes along the row and looks at the plants on its east side.
  for (int i = 0; i < 5; ++i) {
    RgbdFrame frame;
    frame.intrinsics = CameraIntrinsics::from_fov(640, 480, 1.4);
    const double y_m = -1.0 + 0.5 * i;
    frame.T_world_camera = look_at(Vec3(0.0, y_m, 1.0), Vec3(0.75, y_m, 0.8));
    RenderedView seen = glasshouse.render(frame.intrinsics, frame.T_world_camera);
    frame.depth = std::move(seen.depth);
    frame.color = std::move(seen.color);

    const auto detection = detector.detect(frame);  // which pixels are fruit
    if (!detection) {
      std::fprintf(stderr, "%s\n", detection.error().message.c_str());
      return 1;
    }
    const FuseResult fused = fuse(map, frame, detection->fruit);
    std::printf("frame %d: %lld voxels became known\n", i,
                static_cast<long long>(fused.newly_known));
  }

  // What is known?
  std::printf("known %lld voxels, occupied %lld, fruit %lld\n",
              static_cast<long long>(map.observed_voxels()),
              static_cast<long long>(map.occupied_voxels()),
              static_cast<long long>(map.roi_voxels()));
  // Is there anything between two points?
  const bool blocked = ray_blocked(map, Vec3(0.0, 0.2, 1.0), Vec3(0.9, 0.2, 0.02));
  std::printf("the way through the row is %s\n", blocked ? "blocked" : "free");
  // How much would a view from the other end of the row teach?
  const ViewCast cast = cast_view(map, look_at(Vec3(0.0, 1.2, 1.4), Vec3(0.75, 0.0, 0.8)));
  std::printf("a view from above would cross %lld unknown voxels\n",
              static_cast<long long>(cast.unknown.count()));
  // Where to look next?
  const Box region(Vec3(0.4, -1.5, 0.2), Vec3(1.2, 1.5, 1.8));
  const FrontierTargets targets = extract_frontiers(map, region);
  std::printf("targets: %zu at fruits, %zu at surfaces, %zu at the border of what is known\n",
              targets.roi.size(), targets.occupied.size(), targets.border.size());

  if (argc < 2) return 0;
  const auto written = write_map(map, argv[1]);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  return written ? 0 : 1;
}
