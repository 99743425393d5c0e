#include "canopeer/render/sensor_noise.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "canopeer/base/check.h"
#include "canopeer/render/surfaces/pixel_hash.h"

namespace canopeer {
namespace {

// Streams of random numbers of a pixel.
enum Stream : std::uint64_t { kAxial = 1, kLateral, kEdge, kLost, kGrazing, kColor, kExposure };

std::uint64_t bits_of(std::uint64_t key, Stream stream, int u, int v) {
  const auto pixel = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) << 32) |
                     static_cast<std::uint32_t>(u);
  return pixel_hash(pixel_hash(key ^ (stream * 0x9e3779b97f4a7c15ULL)) ^ pixel);
}

double uniform_from(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

/// Nearly normal, mean 0, standard deviation 1, |x| ≤ 6: the sum of 12 bytes' worth of uniforms
/// (Irwin–Hall). Only sums and products: the same on every machine, which log and cos are not.
double normal_from(std::uint64_t bits) {
  std::uint64_t more = pixel_hash(bits);
  int sum = 0;
  for (int i = 0; i < 8; ++i, bits >>= 8) sum += static_cast<int>(bits & 0xff);
  for (int i = 0; i < 4; ++i, more >>= 8) sum += static_cast<int>(more & 0xff);
  constexpr double kScale = 1.0 / 255.998;  // √(12 · (256² − 1) / 12)
  return (sum - 12 * 127.5) * kScale;
}

/// Normal noise that varies smoothly over `cell` pixels, standard deviation 1 everywhere.
double smooth_normal(std::uint64_t key, Stream stream, int u, int v, double cell) {
  if (cell <= 1.0) return normal_from(bits_of(key, stream, u, v));
  const double x = u / cell;
  const double y = v / cell;
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const double s = x - i;
  const double t = y - j;
  const std::array<double, 4> w = {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
  double sum = 0.0;
  double squares = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double weight = w[static_cast<std::size_t>(k)];
    sum += weight * normal_from(bits_of(key, stream, i + (k & 1), j + (k >> 1)));
    squares += weight * weight;
  }
  return sum / std::sqrt(squares);
}

/// Depths around a pixel; 0 and what is outside the image count as very far.
class Neighbourhood {
 public:
  explicit Neighbourhood(const DepthImage& depth) : depth_(depth) {}

  double at(int u, int v) const {
    constexpr double kFar = 1e3;
    if (u < 0 || v < 0 || u >= depth_.width() || v >= depth_.height()) return kFar;
    const float z = depth_.at(u, v);
    return z > 0.0F ? static_cast<double>(z) : kFar;
  }
  double inside(int u, int v) const {
    return at(std::clamp(u, 0, depth_.width() - 1), std::clamp(v, 0, depth_.height() - 1));
  }
  /// Nearest and farthest of the 3 × 3 pixels around.
  std::pair<double, double> extremes(int u, int v) const {
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        low = std::min(low, inside(u + du, v + dv));
        high = std::max(high, inside(u + du, v + dv));
      }
    }
    return {low, high};
  }
  /// Slope of depth along u or v: the gentler of both sides, so that edges do not count.
  double slope_u(int u, int v) const {
    return gentler(inside(u, v) - inside(u - 1, v), inside(u + 1, v) - inside(u, v));
  }
  double slope_v(int u, int v) const {
    return gentler(inside(u, v) - inside(u, v - 1), inside(u, v + 1) - inside(u, v));
  }

 private:
  static double gentler(double a, double b) { return std::abs(a) < std::abs(b) ? a : b; }
  const DepthImage& depth_;
};

/// Cosine between the ray and the surface's normal, from the slopes of depth.
double incidence_cosine(const Neighbourhood& depth, const CameraIntrinsics& camera, int u, int v) {
  // The surface z(u, v) has points z · ray(u, v); its normal is the cross product of the two
  // derivatives.
  const double z = depth.inside(u, v);
  const Vec3 ray = camera.ray(u, v);
  const Vec3 along_u = depth.slope_u(u, v) * ray + Vec3(z / camera.fx, 0.0, 0.0);
  const Vec3 along_v = depth.slope_v(u, v) * ray + Vec3(0.0, z / camera.fy, 0.0);
  const Vec3 n = along_u.cross(along_v);
  return std::abs(n.dot(ray)) / std::sqrt(n.squaredNorm() * ray.squaredNorm());
}

/// Which pixels of a row the second imager, to the right, cannot see.
std::vector<char> shadowed(const DepthImage& depth, double fx_baseline, int v) {
  std::vector<char> hidden(static_cast<std::size_t>(depth.width()), 0);
  // Column in the second image of the leftmost thing seen so far from the right.
  double least = std::numeric_limits<double>::infinity();
  for (int u = depth.width() - 1; u >= 0; --u) {
    const double z = static_cast<double>(depth.at(u, v));
    if (z <= 0.0) continue;
    const double column = u - fx_baseline / z;
    hidden[static_cast<std::size_t>(u)] = column > least + 0.5 ? 1 : 0;
    least = std::min(least, column);
  }
  return hidden;
}

/// One row of a noisy depth image.
class RowSensor {
 public:
  RowSensor(const DepthImage& depth, const CameraIntrinsics& camera, const SensorNoiseOptions& o,
            std::uint64_t key)
      : depth_(depth), around_(depth), camera_(camera), o_(o), key_(key) {}

  void measure(int v, DepthImage* out) const {
    const double fx_baseline = camera_.fx * o_.baseline_m;
    std::vector<char> hidden;
    if (o_.baseline_shadow && fx_baseline > 0.0) hidden = shadowed(depth_, fx_baseline, v);
    for (int u = 0; u < depth_.width(); ++u) {
      const bool shadow = !hidden.empty() && hidden[static_cast<std::size_t>(u)] != 0;
      const double z = shadow || lost(u, v) ? 0.0 : quantised(noisy(surface(u, v), u, v));
      out->at(u, v) =
          z >= camera_.min_range_m && z <= camera_.max_range_m ? static_cast<float>(z) : 0.0F;
    }
  }

 private:
  bool lost(int u, int v) const {
    if (o_.lost_anywhere > 0.0 && uniform_from(bits_of(key_, kLost, u, v)) < o_.lost_anywhere) {
      return true;
    }
    if (o_.kept_above_cosine <= 0.0 || depth_.at(u, v) <= 0.0F) return false;
    const double c = incidence_cosine(around_, camera_, u, v);
    const double kept = (c - o_.lost_below_cosine) / (o_.kept_above_cosine - o_.lost_below_cosine);
    return uniform_from(bits_of(key_, kGrazing, u, v)) >= kept;
  }

  /// Depth of what the pixel sees: itself or, at a wavering edge, its neighbour; 0: nothing.
  double surface(int u, int v) const {
    int su = u;
    int sv = v;
    if (o_.lateral_px > 0.0) {
      su += static_cast<int>(
          std::floor(o_.lateral_px * normal_from(bits_of(key_, kLateral, 2 * u, v)) + 0.5));
      sv += static_cast<int>(
          std::floor(o_.lateral_px * normal_from(bits_of(key_, kLateral, 2 * u + 1, v)) + 0.5));
    }
    su = std::clamp(su, 0, depth_.width() - 1);
    sv = std::clamp(sv, 0, depth_.height() - 1);
    const double z = static_cast<double>(depth_.at(su, sv));
    if (o_.lost_at_edge <= 0.0 && o_.flying_at_edge <= 0.0) return z;
    const auto [near, far] = around_.extremes(su, sv);
    if (far - near <= o_.edge_step * near) return z;
    const std::uint64_t bits = bits_of(key_, kEdge, u, v);
    const double chance = uniform_from(bits);
    if (chance < o_.lost_at_edge) return 0.0;
    if (chance >= o_.lost_at_edge + (1.0 - o_.lost_at_edge) * o_.flying_at_edge) return z;
    // Against the open sky there is nothing to mix with.
    if (far > camera_.max_range_m) return 0.0;
    return near + uniform_from(pixel_hash(bits)) * (far - near);
  }

  double noisy(double z, int u, int v) const {
    const double fx_baseline = camera_.fx * o_.baseline_m;
    if (z <= 0.0 || fx_baseline <= 0.0) return z;
    double disparity = fx_baseline / z;
    if (o_.disparity_noise_px > 0.0) {
      disparity += o_.disparity_noise_px * smooth_normal(key_, kAxial, u, v, o_.correlation_px);
    }
    if (o_.disparity_step_px > 0.0) {
      disparity = o_.disparity_step_px * std::floor(disparity / o_.disparity_step_px + 0.5);
    }
    return disparity > 0.0 ? fx_baseline / disparity : 0.0;
  }

  double quantised(double z) const {
    return o_.depth_step_m > 0.0 ? o_.depth_step_m * std::floor(z / o_.depth_step_m + 0.5) : z;
  }

  const DepthImage& depth_;
  Neighbourhood around_;
  const CameraIntrinsics& camera_;
  const SensorNoiseOptions& o_;
  std::uint64_t key_;
};

}  // namespace

bool SensorNoiseOptions::any_depth() const {
  return baseline_m > 0.0 || lateral_px > 0.0 || depth_step_m > 0.0 || kept_above_cosine > 0.0 ||
         lost_at_edge > 0.0 || flying_at_edge > 0.0 || lost_anywhere > 0.0;
}

bool SensorNoiseOptions::any_color() const {
  return color_read > 0.0 || color_shot > 0.0 || exposure != 1.0 || exposure_spread > 0.0;
}

Expected<void> SensorNoiseOptions::validate() const {
  const bool disparity = disparity_noise_px > 0.0 || disparity_step_px > 0.0 || baseline_shadow;
  if (disparity && baseline_m <= 0.0) {
    return fail("noise of the disparity needs a baseline_m greater than 0");
  }
  const bool grazing = lost_below_cosine > 0.0 || kept_above_cosine > 0.0;
  if (grazing && kept_above_cosine <= lost_below_cosine) {
    return fail("kept_above_cosine must be greater than lost_below_cosine");
  }
  return {};
}

const std::vector<std::string>& sensor_noise_names() {
  static const std::vector<std::string> kNames = {"none", "d435", "d405"};
  return kNames;
}

SensorNoiseOptions sensor_noise_preset(const std::string& name) {
  SensorNoiseOptions o;
  if (name == "none") return o;
  CANOPEER_CHECK(name == "d435" || name == "d405", "an unknown preset of sensor noise");
  o.baseline_m = name == "d435" ? 0.050 : 0.018;
  o.disparity_noise_px = 0.08;
  o.correlation_px = 3.0;
  o.disparity_step_px = 1.0 / 32.0;
  o.baseline_shadow = true;
  o.lateral_px = 0.8;
  o.depth_step_m = name == "d435" ? 0.001 : 0.0001;
  o.lost_below_cosine = 0.10;  // 84°
  o.kept_above_cosine = 0.34;  // 70°
  o.lost_at_edge = 0.3;
  o.flying_at_edge = 0.2;
  o.lost_anywhere = 0.005;
  o.color_read = 2.0;
  o.color_shot = 0.06;
  o.exposure_spread = 0.03;
  return o;
}

DepthImage noisy_depth(const DepthImage& depth, const CameraIntrinsics& camera,
                       const SensorNoiseOptions& noise, std::uint64_t key) {
  CANOPEER_CHECK(depth.width() == camera.width && depth.height() == camera.height,
                 "depth has the camera's size");
  DepthImage out(depth.width(), depth.height(), 0.0F);
  const RowSensor sensor(depth, camera, noise, key);
  tbb::parallel_for(0, depth.height(), [&](int v) { sensor.measure(v, &out); });
  return out;
}

ColorImage noisy_color(const ColorImage& color, const SensorNoiseOptions& noise,
                       std::uint64_t key) {
  ColorImage out(color.width(), color.height());
  const double gain =
      noise.exposure *
      std::max(0.0, 1.0 + noise.exposure_spread * normal_from(bits_of(key, kExposure, 0, 0)));
  const auto measured = [&](std::uint8_t value, int u, int v) {
    const double x = gain * value;
    const double sd = std::sqrt(noise.color_read * noise.color_read + noise.color_shot * x);
    const double noisy = x + sd * normal_from(bits_of(key, kColor, u, v));
    return static_cast<std::uint8_t>(std::clamp(noisy, 0.0, 255.0) + 0.5);
  };
  tbb::parallel_for(0, color.height(), [&](int v) {
    for (int u = 0; u < color.width(); ++u) {
      const Rgb& c = color.at(u, v);
      out.at(u, v) = {measured(c.r, 3 * u, v), measured(c.g, 3 * u + 1, v),
                      measured(c.b, 3 * u + 2, v)};
    }
  });
  return out;
}

}  // namespace canopeer
