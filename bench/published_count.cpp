// Fruits of recorded runs as the published system would have counted them: each frame is rendered
// anew at its recorded pose, searched for fruit as the mission does, and given to the published
// chain from pixels to fruits (published_surface.h). Its clusters are paired with the true fruits
// greedily, up to 0.20 m, as the paper counts. Prints a line a run. Settings see the same poses
// with another camera or detector, say noise=d435:
//   published_count MISSION.yaml [KEY=VALUE…] RUN_DIR…
#include <cstdio>

#include "canopeer/config/mission_file.h"
#include "canopeer/eval/matching.h"
#include "canopeer/record/record_file.h"
#include "canopeer/render/rgbd_sensor.h"
#include "published_surface.h"
#include "support/must.h"

namespace canopeer {
namespace {

/// One way to count, and what it came to.
struct Count {
  PublishedSurface surface;
  bool every_view = true;  ///< or only where the arm stood still to plan the next motion
};

void count(const std::string& mission, Overrides settings, const std::string& run_dir) {
  const RunRecord record = must(read_record(run_dir));
  settings.emplace_back("seed", std::to_string(record.header.seed));
  const auto file = must(load_mission(mission, settings, {CANOPEER_SOURCE_DIR "/compute_tables"}));
  const auto world = must(build_world(file.world, file.mission.seed));
  const Renderer renderer(world.scene);
  RgbdSensorOptions options = file.simulation.sensor;
  options.intrinsics = file.simulation.camera;
  options.seed = file.mission.seed;
  const RgbdSensor sensor(renderer, world.scene, options);
  const auto detector = must(DetectorRegistry::built_in().make(file.mission.detector));

  std::vector<Count> counts;
  counts.push_back({PublishedSurface({.drop_outliers = false}), true});
  counts.push_back({PublishedSurface({}), true});
  counts.push_back({PublishedSurface({}), false});
  constexpr double kStoodStillS = 0.25;
  for (std::size_t i = 0; i < record.views.size(); ++i) {
    const ViewEvent& view = record.views[i];
    const bool stood =
        i + 1 < record.views.size() && record.views[i + 1].planning_s >= kStoodStillS;
    const RgbdFrame frame =
        sensor.capture(view.T_world_camera, static_cast<std::uint64_t>(view.view));
    const Detection detection = must(detector->detect(frame));
    for (Count& one : counts) {
      if (one.every_view || stood) one.surface.add(frame, detection.fruit);
    }
  }
  std::printf("%-40s views %3zu ", run_dir.c_str(), record.views.size());
  for (const Count& one : counts) {
    const std::vector<Vec3> centres = one.surface.fruit_centres();
    const FruitMatching matching = match_greedy(centres, world.scene.fruits);
    std::printf("  %zu of %zu clusters", matching.pairs.size(), centres.size());
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace canopeer

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: published_count MISSION.yaml [KEY=VALUE…] RUN_DIR…\n");
    return 2;
  }
  std::printf("counted: all points; with outlier removal; the same, where the arm stood only\n");
  canopeer::Overrides settings;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
      canopeer::count(argv[1], settings, word);
    } else {
      settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
  }
  return 0;
}
