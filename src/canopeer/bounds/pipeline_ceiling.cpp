#include "canopeer/bounds/pipeline_ceiling.h"

#include <algorithm>
#include <utility>

#include "canopeer/base/rng.h"
#include "canopeer/bounds/visibility_ceiling.h"
#include "canopeer/eval/matching.h"
#include "canopeer/eval/surface_coverage.h"
#include "canopeer/eval/surface_score.h"
#include "canopeer/fruit/fruit_map.h"
#include "canopeer/render/renderer.h"
#include "canopeer/render/rgbd_sensor.h"

namespace canopeer {
namespace {

constexpr int kLookEvery = 4;  // frames between two looks at what is found

std::vector<PoolViewId> shuffled(std::span<const PoolViewId> views, std::uint64_t seed) {
  std::vector<PoolViewId> order(views.begin(), views.end());
  Rng rng(seed, "order of cover views");
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.index(i)]);
  return order;
}

/// By FruitTruth::id: whether the map reports it.
std::vector<char> found_fruits(const FruitMap& map, const Scene& scene, FruitMatching* matching) {
  std::vector<Vec3> centres;
  for (const FruitEstimate& fruit : map.fruits()) centres.push_back(fruit.centre);
  *matching = match_optimal(centres, scene.fruits);
  std::vector<char> found(scene.fruits.size(), 0);
  for (const FruitPair& pair : matching->pairs) found[static_cast<std::size_t>(pair.truth)] = 1;
  return found;
}

/// A case for each fruit of which more has been seen than when it was looked at last.
class Cases {
 public:
  void add(const std::vector<double>& area, const std::vector<char>& found) {
    last_.resize(area.size(), 0.0);
    for (std::size_t f = 0; f < area.size(); ++f) {
      if (area[f] <= last_[f]) continue;
      cases_.push_back({area[f], found[f] != 0});
      last_[f] = area[f];
    }
  }
  [[nodiscard]] std::vector<FindCase> take() { return std::move(cases_); }

 private:
  std::vector<double> last_;
  std::vector<FindCase> cases_;
};

double seen_share(const Scene& scene, const std::vector<double>& coverage) {
  double seen = 0.0;
  double all = 0.0;
  for (const FruitTruth& fruit : scene.fruits) {
    if (!fruit.counted) continue;
    seen += coverage[static_cast<std::size_t>(fruit.id)] * fruit.surface_cm2;
    all += fruit.surface_cm2;
  }
  return all > 0.0 ? seen / all : 0.0;
}

}  // namespace

FindCalibration calibrate_find(std::vector<FindCase> cases) {
  FindCalibration result;
  result.cases = static_cast<int>(cases.size());
  std::stable_sort(cases.begin(), cases.end(),
                   [](const FindCase& a, const FindCase& b) { return a.area_cm2 < b.area_cm2; });
  const auto found = std::count_if(cases.begin(), cases.end(), [](auto& c) { return c.found; });
  if (found == 0) return result;
  // With the threshold before case k, those found below it and those missed above it are wrong.
  auto wrong = static_cast<std::ptrdiff_t>(cases.size()) - found;
  auto least_wrong = wrong;
  std::ptrdiff_t found_so_far = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    if (cases[k].found) {
      if (found_so_far == 0) result.least_cm2 = cases[k].area_cm2;
      if (++found_so_far * 20 >= found && result.twentieth_cm2 == 0.0) {
        result.twentieth_cm2 = cases[k].area_cm2;
      }
    }
    wrong += cases[k].found ? 1 : -1;
    if (wrong < least_wrong) {
      least_wrong = wrong;
      const std::size_t next = std::min(k + 1, cases.size() - 1);
      result.even_cm2 = 0.5 * (cases[k].area_cm2 + cases[next].area_cm2);
    }
  }
  result.wrong_share = static_cast<double>(least_wrong) / static_cast<double>(cases.size());
  return result;
}

Expected<PipelineCeiling> pipeline_ceiling(const Scene& scene, const MissionOptions& mission,
                                           const DetectorRegistry& detectors,
                                           const SimulationOptions& simulation,
                                           const ViewPool& pool, std::span<const PoolViewId> views,
                                           const PipelineCallbacks& callbacks) {
  auto detector = detectors.make(mission.detector);
  if (!detector) return fail_in("detector", detector.error());
  const Renderer renderer(scene);
  RgbdSensorOptions camera = simulation.sensor;
  camera.intrinsics = simulation.camera;
  camera.seed = simulation.seed;
  const RgbdSensor sensor(renderer, scene, camera);
  FruitMap map(mission.fruit);
  PipelineCeiling result;
  FruitMatching matching;
  Cases cases;
  std::vector<char> seen(pool.patches.fruit.size(), 0);
  for (const PoolViewId& id : shuffled(views, mission.seed)) {
    if (callbacks.stopped && callbacks.stopped()) return fail("stopped while frames were taken");
    const PoolView& view = pool.segments[static_cast<std::size_t>(id.segment)][id.view];
    const RgbdFrame frame =
        sensor.capture(view.T_world_camera, static_cast<std::uint64_t>(result.views));
    auto detection = (*detector)->detect(frame);
    if (!detection) return fail_in("detector", detection.error());
    map.add(frame, detection->fruit);
    map.update();
    for (const std::uint32_t p : view.patches) seen[p] = 1;
    if (++result.views % kLookEvery == 0) {
      cases.add(seen_area_cm2(pool.patches, seen), found_fruits(map, scene, &matching));
    }
    if (callbacks.progress) callbacks.progress(result.views, static_cast<int>(views.size()));
  }
  map.update_all();
  static_cast<void>(found_fruits(map, scene, &matching));
  result.detected = static_cast<int>(matching.pairs.size());
  result.false_positives = matching.false_positives;
  const PointCloud cloud = map.cloud();
  result.surface = seen_share(scene, fruit_coverage(scene, cloud));
  if (const auto score = surface_score(scene, cloud.points)) {
    result.surface_recall = score->recall;
    result.surface_precision = score->precision;
    result.surface_f1 = score->f1;
  }
  result.find = calibrate_find(cases.take());
  return result;
}

}  // namespace canopeer
