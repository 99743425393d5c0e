#include <cmath>
#include <cstdio>

#include "canopeer/base/atomic_file.h"
#include "canopeer/render/occlusion.h"
#include "canopeer/scene/scene_hash.h"
#include "commands.h"
#include "exit_status.h"
#include "occlusion_report.h"
#include "robot_source.h"
#include "scene_source.h"
#include "world_builder.h"

namespace canopeer::app {
namespace {

constexpr int kFruitsLookedAt = 240;  // of worlds with more, every n-th

struct Counts {
  int ripe = 0;
  int turning = 0;
  int green = 0;
};

Counts count(const Scene& scene) {
  Counts counts;
  for (const FruitTruth& fruit : scene.fruits) {
    counts.ripe += fruit.ripeness == Ripeness::ripe;
    counts.turning += fruit.ripeness == Ripeness::turning;
    counts.green += fruit.ripeness == Ripeness::green;
  }
  return counts;
}

/// Where a mission lets its camera be and what it lets it look for.
class MissionBoxes {
 public:
  MissionBoxes(const MissionFile& file, const RobotModel& robot)
      : views_(file.mission.planners.vmp.builder.sampler) {
    for (const SegmentPlan& segment : file.mission.segments) {
      segments_.push_back({robot.T_world_base(segment.trolley), robot.workspace(segment.side),
                           robot.sampling_region(segment.side)});
    }
  }

  /// Positions 10 cm apart in the workspaces of the segments that look for the fruit at all, at the
  /// distance from it that views are sampled at. Whether the arm gets there is not asked.
  [[nodiscard]] std::vector<Vec3> positions(const FruitTruth& fruit) const {
    std::vector<Vec3> eyes;
    for (const Segment& segment : segments_) {
      const Vec3 p = segment.T_world_base.inverse(Eigen::Isometry) * fruit.centre;
      if (segment.region.contains(p)) add_positions(segment, p, &eyes);
    }
    return eyes;
  }

  [[nodiscard]] bool looks_for(const FruitTruth& fruit) const {
    return std::any_of(segments_.begin(), segments_.end(), [&](const Segment& segment) {
      return segment.region.contains(segment.T_world_base.inverse(Eigen::Isometry) * fruit.centre);
    });
  }

 private:
  struct Segment {
    Pose T_world_base;
    Box workspace, region;  // arm base frame
  };

  void add_positions(const Segment& segment, const Vec3& p_base, std::vector<Vec3>* eyes) const {
    constexpr double kStep = 0.10;
    const Vec3 steps = (segment.workspace.sizes() / kStep).array().floor();
    for (int i = 0; i <= static_cast<int>(steps.x()); ++i) {
      for (int j = 0; j <= static_cast<int>(steps.y()); ++j) {
        for (int k = 0; k <= static_cast<int>(steps.z()); ++k) {
          const Vec3 eye = segment.workspace.min() + kStep * Vec3(i, j, k);
          const double distance = (eye - p_base).norm();
          if (distance < views_.min_target_distance_m || distance > views_.max_target_distance_m) {
            continue;
          }
          eyes->push_back(segment.T_world_base * eye);
        }
      }
    }
  }

  ViewSamplerOptions views_;
  std::vector<Segment> segments_;
};

OcclusionReport ring_report(const Scene& scene, const OcclusionProbe& probe) {
  RingOptions ring;
  ring.top_m = std::max(ring.top_m, scene.bounds(true).max().z());
  return OcclusionReport(visibilities(scene, probe, kFruitsLookedAt, [&](const FruitTruth& fruit) {
    return ring_positions(fruit.centre, ring);
  }));
}

struct MissionView {
  OcclusionReport occlusion;
  int looked_for = 0;  ///< fruits that count and lie in a sampling region
};

MissionView mission_view(const Scene& scene, const OcclusionProbe& probe, const MissionFile& file) {
  const RobotModel robot = robot_of(file);
  const MissionBoxes boxes(file, robot);
  MissionView view{OcclusionReport(visibilities(
                       scene, probe, kFruitsLookedAt,
                       [&](const FruitTruth& fruit) { return boxes.positions(fruit); })),
                   0};
  for (const FruitTruth& fruit : scene.fruits) {
    view.looked_for += fruit.counted && boxes.looks_for(fruit);
  }
  return view;
}

std::string hash_text(const Scene& scene) {
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(scene_hash(scene)));
  return text;
}

std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", value);
  return text;
}

std::string lai_of(const Scene& scene) {
  return scene.ground_m2 > 0.0 ? number(scene.leaf_area() / scene.ground_m2) : "null";
}

void print_counts(const Scene& scene) {
  const Counts counts = count(scene);
  std::printf(
      "scene             %s, seed %llu, hash %s\nplants            %d\ntriangles         %zu\n"
      "fruits_counted    %d\nfruits_total      %zu (%d ripe, %d turning, %d green)\n"
      "leaf area         %.2f m²\nleaf area index   %s (on %.2f m² of ground)\n",
      scene.name.c_str(), static_cast<unsigned long long>(scene.seed), hash_text(scene).c_str(),
      scene.plant_count(), scene.triangle_count(), scene.counted_fruits(), scene.fruits.size(),
      counts.ripe, counts.turning, counts.green, scene.leaf_area(), lai_of(scene).c_str(),
      scene.ground_m2);
}

std::string json_of(const Scene& scene, const std::optional<OcclusionReport>& ring,
                    const std::optional<MissionView>& mission) {
  const Counts counts = count(scene);
  std::string name;
  for (const char c : scene.name) {
    name += c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20 ? '_' : c;
  }
  std::string json = "{\n  \"name\": \"" + name + "\",\n  \"seed\": " + std::to_string(scene.seed) +
                     ",\n  \"hash\": \"" + hash_text(scene) +
                     "\",\n  \"plants\": " + std::to_string(scene.plant_count()) +
                     ",\n  \"triangles\": " + std::to_string(scene.triangle_count()) +
                     ",\n  \"fruits_counted\": " + std::to_string(scene.counted_fruits()) +
                     ",\n  \"fruits_total\": " + std::to_string(scene.fruits.size()) +
                     ",\n  \"ripe\": " + std::to_string(counts.ripe) +
                     ",\n  \"turning\": " + std::to_string(counts.turning) +
                     ",\n  \"green\": " + std::to_string(counts.green) +
                     ",\n  \"leaf_area_m2\": " + number(scene.leaf_area()) +
                     ",\n  \"ground_m2\": " + number(scene.ground_m2) +
                     ",\n  \"leaf_area_index\": " + lai_of(scene);
  json += ",\n  \"ring\": " + (ring ? as_json(*ring) : "null");
  json += ",\n  \"mission_boxes\": " + (mission ? as_json(mission->occlusion) : "null");
  json += ",\n  \"fruits_in_sampling_region\": " +
          (mission ? std::to_string(mission->looked_for) : "null");
  return json + "\n}\n";
}

}  // namespace

/// Counts, leaf area, and how hidden the fruits are.
void scene_inspect(const SceneArguments& arguments) {
  const SceneSource source = load_scene_source(arguments.mission);
  const ImportedScene world =
      build_world_or_stop(source.world, source.seed,
                          source.mission ? source.mission->mission.detector : DetectorOptions());
  const Scene& scene = world.scene;
  print_counts(scene);
  std::optional<OcclusionReport> ring;
  std::optional<MissionView> mission;
  if (!arguments.counts_only && scene.counted_fruits() > 0) {
    const OcclusionProbe probe(scene);
    ring = ring_report(scene, probe);
    std::printf("\nfrom a ring around each fruit (%d fruits looked at)\n%s", ring->fruits,
                as_text(*ring).c_str());
    if (source.mission) {
      mission = mission_view(scene, probe, *source.mission);
      std::printf(
          "\nfrom the mission's workspace boxes (%d of the fruits that count lie in a "
          "sampling region)\n%s",
          mission->looked_for, as_text(mission->occlusion).c_str());
    }
  }
  if (arguments.json.empty()) return;
  value_or_stop(write_file(arguments.json, json_of(scene, ring, mission)), kFailed);
}

}  // namespace canopeer::app
