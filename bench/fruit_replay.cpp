// Recorded runs seen through other cameras and detectors: each frame is rendered anew at its
// recorded pose, searched for fruit and given to a fruit map, which is then held against the truth.
// Writes one line a candidate and look into candidates.csv: what the confidences are worth.
//   fruit_replay MISSION.yaml OUT_DIR CONDITION[,CONDITION…] RUN_DIR…
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "canopeer/config/mission_file.h"
#include "canopeer/detect/pixel_score.h"
#include "canopeer/eval/matching.h"
#include "canopeer/eval/surface_coverage.h"
#include "canopeer/fruit/fruit_map.h"
#include "canopeer/record/record_file.h"
#include "canopeer/render/rgbd_sensor.h"
#include "false_spots.h"
#include "support/must.h"

namespace canopeer {
namespace {

const std::string kModel = CANOPEER_SOURCE_DIR "/tests/detect/models/colour_rule.onnx";
// Windows that let dry leaves, pink labels and clay pipes through.
const std::string kLooseWindows =
    "[{ripeness: ripe, hue_low_deg: -30, hue_high_deg: 14, min_saturation: 0.35, min_value: 0.12},"
    " {ripeness: turning, hue_low_deg: 14, hue_high_deg: 40, min_saturation: 0.45, min_value: "
    "0.12}]";

/// What a mission may be told about camera and detector.
Overrides condition(const std::string& name) {
  const Overrides noise = {{"noise", "d435"}};
  const auto with = [](Overrides a, const Overrides& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const auto labels = [&](const char* wrong, const char* radius) {
    return with(noise, {{"label_noise", wrong},
                        {"detector.kind", "labels"},
                        {"detector.majority_radius_px", radius}});
  };
  const std::map<std::string, Overrides> all = {
      {"clean", {}},
      {"d435", noise},
      {"labels70", labels("0.3", "3")},
      {"labels60", labels("0.4", "3")},
      {"labels55", labels("0.45", "3")},
      {"loose", with(noise, {{"detector.windows", kLooseWindows}})},
      {"spots", noise},
      {"spots70", labels("0.3", "3")},
      {"network", with(noise, {{"detector.kind", "network"}, {"detector.model", kModel}})}};
  const auto found = all.find(name);
  if (found != all.end()) return found->second;
  std::fprintf(stderr, "fruit_replay: no condition '%s'; there are:", name.c_str());
  for (const auto& [known, unused] : all) std::fprintf(stderr, " %s", known.c_str());
  std::fprintf(stderr, "\n");
  std::exit(2);
}

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

double share(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

/// 1: a fruit that counts, 0: none, −1: a green one, which is neither right nor wrong.
std::vector<int> verdicts(const std::vector<FruitEstimate>& fruits,
                          const std::vector<FruitTruth>& truth) {
  std::vector<Vec3> centres;
  for (const FruitEstimate& f : fruits) centres.push_back(f.centre);
  std::vector<int> verdict(fruits.size(), 0);
  for (const FruitPair& pair : match_optimal(centres, truth).pairs) verdict[pair.estimate] = 1;
  for (std::size_t i = 0; i < fruits.size(); ++i) {
    for (const FruitTruth& t : truth) {
      const bool here = (t.centre - centres[i]).norm() <= kStrictMatchDistanceM;
      if (!t.counted && verdict[i] == 0 && here) verdict[i] = -1;
    }
  }
  return verdict;
}

class Replay {
 public:
  Replay(const std::string& mission, const std::string& name, const RunRecord& record,
         std::string run)
      : name_(name), run_(std::move(run)), record_(record) {
    Overrides overrides = condition(name);
    overrides.emplace_back("seed", std::to_string(record.header.seed));
    overrides.emplace_back("fruit.min_confidence", "0");
    file_ = must(load_mission(mission, overrides, {CANOPEER_SOURCE_DIR "/compute_tables"}));
    world_ = must(build_world(file_.world, file_.mission.seed));
  }

  void run(std::ofstream& candidates) {
    const Renderer renderer(world_.scene);
    RgbdSensorOptions options = file_.simulation.sensor;
    options.intrinsics = file_.simulation.camera;
    options.seed = file_.mission.seed;
    const RgbdSensor sensor(renderer, world_.scene, options);
    RgbdSensorOptions perfect;
    perfect.intrinsics = options.intrinsics;
    const RgbdSensor true_sensor(renderer, world_.scene, perfect);
    const auto detector = must(DetectorRegistry::built_in().make(file_.mission.detector));
    FruitMap map(file_.mission.fruit);
    FruitMap seen;  // by a perfect camera and detector: what there was to see
    const FalseSpots spots(world_.scene, options.seed);
    const bool spotted = name_.starts_with("spots");
    PixelCounts pixels;
    std::vector<double> update_ms;
    for (const ViewEvent& view : record_.views) {
      const auto number = static_cast<std::uint64_t>(view.view);
      RgbdFrame frame = sensor.capture(view.T_world_camera, number);
      frame.time_s = view.t_s;
      const RgbdFrame truth = true_sensor.capture(view.T_world_camera, number);
      Detection detection = must(detector->detect(frame));
      if (spotted) spots.apply(truth, number, detection.fruit);
      pixels.add(detection.fruit, counted(truth), nullptr);
      seen.add(truth, counted(truth));
      const double begin = cpu_ms();
      map.add(frame, detection.fruit);
      map.update();
      update_ms.push_back(cpu_ms() - begin);
      if (view.view % 4 == 3) look(map, view.view, false, candidates);
    }
    map.update_all();
    seen.update_all();
    look(map, static_cast<int>(record_.views.size()), true, candidates);
    report(map, fruit_coverage(world_.scene, seen.cloud()), pixels.score(), update_ms);
  }

 private:
  static Mask counted(const RgbdFrame& truth) {
    Mask mask(truth.labels.width(), truth.labels.height(), 0);
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
      const PixelLabel label = truth.labels.pixels()[i];
      if (counted_fruit(label)) mask.pixels()[i] = static_cast<std::uint8_t>(label);
    }
    return mask;
  }

  void look(const FruitMap& map, int view, bool last, std::ofstream& out) const {
    const std::vector<FruitEstimate>& fruits = map.candidates();
    const std::vector<int> verdict = verdicts(fruits, world_.scene.fruits);
    for (std::size_t i = 0; i < fruits.size(); ++i) {
      const FruitEvidence e = map.evidence(i);
      out << name_ << ',' << run_ << ',' << view << ',' << last << ',' << fruits[i].id << ','
          << verdict[i] << ',' << fruits[i].confidence << ',' << e.area_cm2 << ',' << e.seen_share
          << ',' << e.rms_m << ',' << e.fruit_share << ',' << e.views << ',' << e.size_sds << ','
          << e.normal_spread << ',' << e.foreign_share << ',' << e.free_share << '\n';
    }
  }

  /// At the reported confidence of one half.
  void report(const FruitMap& map, const std::vector<double>& coverage, const PixelScore& pixels,
              std::vector<double>& update_ms) const {
    std::vector<FruitEstimate> fruits;
    for (const FruitEstimate& f : map.fruits()) {
      if (f.confidence >= 0.5) fruits.push_back(f);
    }
    std::vector<Vec3> centres;
    for (const FruitEstimate& f : fruits) centres.push_back(f.centre);
    const std::vector<FruitTruth>& truth = world_.scene.fruits;
    const FruitMatching matching = match_optimal(centres, truth);
    double centre = 0.0, volume = 0.0, half = 0.0, half_centre = 0.0, half_volume = 0.0;
    double found30 = 0.0, all30 = 0.0;
    for (const FruitPair& pair : matching.pairs) {
      const FruitTruth& t = truth[static_cast<std::size_t>(pair.truth)];
      const double error =
          std::abs(fruits[static_cast<std::size_t>(pair.estimate)].volume_cm3 / t.volume_cm3 - 1.0);
      centre += pair.distance_m;
      volume += error;
      const double seen = coverage[static_cast<std::size_t>(pair.truth)];
      found30 += seen >= 0.3;
      if (seen < 0.5) continue;
      half += 1.0;
      half_centre += pair.distance_m;
      half_volume += error;
    }
    for (std::size_t i = 0; i < truth.size(); ++i) all30 += truth[i].counted && coverage[i] >= 0.3;
    const double found = static_cast<double>(matching.pairs.size());
    std::sort(update_ms.begin(), update_ms.end());
    std::printf(
        "%-9s %-8s views %3zu  found %2.0f false %d  centre %.2f mm volume %.1f %%  half seen "
        "%2.0f: "
        "%.2f mm %.1f %%  30 %% seen %2.0f of %2.0f F1 %.3f  pixels P %.3f R %.3f IoU %.3f  update "
        "median %.1f p95 %.1f ms\n",
        name_.c_str(), run_.c_str(), record_.views.size(), found, matching.false_positives,
        1e3 * share(centre, found), 1e2 * share(volume, found), half,
        1e3 * share(half_centre, half), 1e2 * share(half_volume, half), found30, all30,
        share(2.0 * found30, found30 + all30 + matching.false_positives), pixels.precision,
        pixels.recall, pixels.iou, update_ms[update_ms.size() / 2],
        update_ms[update_ms.size() * 95 / 100]);
    std::fflush(stdout);
  }

  std::string name_, run_;
  const RunRecord& record_;
  MissionFile file_;
  ImportedScene world_;
};

}  // namespace
}  // namespace canopeer

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr,
                 "usage: fruit_replay MISSION.yaml OUT_DIR CONDITION[,CONDITION…] RUN_DIR…\n");
    return 2;
  }
  std::filesystem::create_directories(argv[2]);
  std::ofstream out(std::filesystem::path(argv[2]) / "candidates.csv");
  out << "condition,run,view,last,id,real,confidence,area_cm2,seen_share,rms_m,fruit_share,views,"
         "size_sds,normal_spread,foreign_share,free_share\n";
  for (int i = 4; i < argc; ++i) {
    const canopeer::RunRecord record = canopeer::must(canopeer::read_record(argv[i]));
    std::istringstream names(argv[3]);
    for (std::string name; std::getline(names, name, ',');) {
      const std::string run = "seed" + std::to_string(record.header.seed);
      canopeer::Replay(argv[1], name, record, run).run(out);
    }
  }
  return out.good() ? 0 : 1;
}
