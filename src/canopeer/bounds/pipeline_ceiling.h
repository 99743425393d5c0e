#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/bounds/set_cover.h"
#include "canopeer/bounds/view_pool.h"
#include "canopeer/detect/detector_registry.h"
#include "canopeer/mission/mission_options.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sim/simulation.h"

namespace canopeer {

/// How much of a fruit must have been seen for the fruit map to report it within 0.05 m.
struct FindCalibration {
  /// Least seen area with which a fruit has ever been reported, cm²; and of one fruit in twenty:
  /// what bounds go by, who must not promise too little.
  double least_cm2 = 0.0;
  double twentieth_cm2 = 0.0;
  /// The area that tells found from not found with the fewest errors: what plans go by.
  double even_cm2 = 0.0;
  double wrong_share = 0.0;  ///< of the cases, by that area
  int cases = 0;             ///< a fruit, and what had been seen of it when it was looked at
};

/// What the frames of given views become in our own fruit map.
struct PipelineCeiling {
  int views = 0;
  int detected = 0;  ///< optimal pairs, 0.05 m
  int false_positives = 0;
  double surface = 0.0;  ///< share of the counted fruits' surface that was seen
  std::optional<double> surface_recall, surface_precision, surface_f1;  ///< at 0.015 m
  FindCalibration find;
};

/// `stopped`: asked before each frame. `progress`: frames done.
struct PipelineCallbacks {
  std::function<void(int done, int all)> progress{};
  std::function<bool()> stopped{};
};

/// Takes a frame at each view with the mission's camera (its noise, its size), feeds detector and
/// fruit map as a mission does, and scores what they report. The views come in an order drawn by
/// the mission's seed, so that fruits are seen bit by bit: after every fourth frame each fruit's
/// seen area is held against whether it is reported, which calibrates FindRule. The error is the
/// detector's, or a stop.
[[nodiscard]] Expected<PipelineCeiling> pipeline_ceiling(
    const Scene& scene, const MissionOptions& mission, const DetectorRegistry& detectors,
    const SimulationOptions& simulation, const ViewPool& pool, std::span<const PoolViewId> views,
    const PipelineCallbacks& callbacks = {});

/// Cases → thresholds.
struct FindCase {
  double area_cm2 = 0.0;
  bool found = false;
};
[[nodiscard]] FindCalibration calibrate_find(std::vector<FindCase> cases);

}  // namespace canopeer
