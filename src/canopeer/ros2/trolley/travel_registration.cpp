#include "canopeer/ros2/trolley/travel_registration.h"

#include <algorithm>
#include <cmath>

#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

constexpr double kLeastOnMap = 0.02;     // share of points, and
constexpr int kLeastPointsOnMap = 50;    // number, for there to be anything
constexpr double kLeastContrast = 0.05;  // of the best shift against the middle of all
constexpr double kDoubt = 0.75;          // another shift with so much of the contrast may be it
constexpr int kPeakSteps = 6;            // so near a shift is the same peak: 3 voxels

/// Points that have depth, world frame, about as many as wanted.
std::vector<Vec3> points_of(const RgbdFrame& frame, const TravelRegistrationOptions& options) {
  const double pixels = static_cast<double>(frame.depth.width()) * frame.depth.height();
  const int step =
      std::max(1, static_cast<int>(std::sqrt(pixels / std::max(1, options.max_points))));
  std::vector<Vec3> points;
  for (int v = step / 2; v < frame.depth.height(); v += step) {
    for (int u = step / 2; u < frame.depth.width(); u += step) {
      const double depth = frame.depth.at(u, v);
      if (!(depth > 0.0) || !(depth <= options.max_range_m)) continue;
      points.push_back(frame.T_world_camera * (depth * frame.intrinsics.ray(u, v)));
    }
  }
  return points;
}

struct Agreement {
  int occupied = 0;
  int free = 0;
};

Agreement agreement_of(const VoxelMap& map, const std::vector<Vec3>& points, const Vec3& shift) {
  Agreement agreement;
  for (const Vec3& point : points) {
    const Occupancy there = map.occupancy(voxel_at(point + shift, map.resolution_m()));
    if (there == Occupancy::occupied) ++agreement.occupied;
    if (there == Occupancy::free) ++agreement.free;
  }
  return agreement;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Where the parabola through a peak and its neighbours is highest, in steps from the peak.
double peak_offset(double before, double peak, double after) {
  const double bend = before - 2.0 * peak + after;
  return bend >= 0.0 ? 0.0 : std::clamp(0.5 * (before - after) / bend, -0.5, 0.5);
}

/// Whether one shift stands out.
bool stands_out(const std::vector<double>& scores, std::size_t best) {
  const double middle = median(scores);
  const double contrast = scores[best] - middle;
  if (contrast < kLeastContrast) return false;
  // At the end of the reach the true peak may lie beyond.
  if (best == 0 || best + 1 == scores.size()) return false;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const std::size_t away = i > best ? i - best : best - i;
    if (away > kPeakSteps && scores[i] - middle > kDoubt * contrast) return false;
  }
  return true;
}

}  // namespace

TravelRegistration register_travel(const VoxelMap& map, const RgbdFrame& frame,
                                   const Vec3& axis_world,
                                   const TravelRegistrationOptions& options) {
  const std::vector<Vec3> points = points_of(frame, options);
  TravelRegistration found;
  found.points = static_cast<int>(points.size());
  const double step_m = 0.5 * map.resolution_m();
  const int steps = static_cast<int>(std::ceil(options.reach_m / step_m));
  std::vector<double> scores;
  int most_on_map = 0;
  for (int i = -steps; i <= steps; ++i) {
    const Agreement agreement = agreement_of(map, points, i * step_m * axis_world);
    most_on_map = std::max(most_on_map, agreement.occupied);
    scores.push_back(points.empty() ? 0.0
                                    : static_cast<double>(agreement.occupied - agreement.free) /
                                          static_cast<double>(points.size()));
  }
  const auto best =
      static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  found.agreement = scores[best];
  found.agreement_unshifted = scores[static_cast<std::size_t>(steps)];
  const double least = std::max<double>(kLeastPointsOnMap, kLeastOnMap * found.points);
  if (most_on_map < least) return found;
  found.kind = TravelRegistration::Kind::unclear;
  if (!stands_out(scores, best)) return found;
  found.kind = TravelRegistration::Kind::clear;
  found.shift_m = (static_cast<int>(best) - steps +
                   peak_offset(scores[best - 1], scores[best], scores[best + 1])) *
                  step_m;
  return found;
}

std::string in_words(const TravelRegistration& registration, double believed_m) {
  const std::string believed = "travel " + figure(believed_m, 3) + " m is believed";
  switch (registration.kind) {
    case TravelRegistration::Kind::nothing_there:
      return "trolley: nothing is mapped yet where the camera looks; " + believed;
    case TravelRegistration::Kind::unclear:
      return "trolley: the map does not say clearly where it stands; " + believed;
    case TravelRegistration::Kind::clear:
      break;
  }
  return "trolley: by the map it stands at travel " + figure(believed_m + registration.shift_m, 3) +
         " m, " + figure(1000.0 * registration.shift_m, 0) + " mm beside what was believed (" +
         figure(100.0 * registration.agreement, 0) + " % of " +
         std::to_string(registration.points) + " points agree, " +
         figure(100.0 * registration.agreement_unshifted, 0) + " % before)";
}

}  // namespace canopeer::ros
