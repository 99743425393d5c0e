#include "canopeer/run/fruit_colors.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <vector>

namespace canopeer {
namespace {

constexpr std::size_t kMostTriangles = 200;  // of a part, evenly chosen
constexpr double kGrey = 0.1;                // saturation below which there is no hue to speak of

/// Colours of one fruit, each with the area it stands for.
struct Sample {
  std::vector<Rgb> colors;
  std::vector<double> areas;
};

Rgb rounded(const Eigen::Vector3f& c) {
  const auto level = [](float x) {
    return static_cast<std::uint8_t>(std::clamp(x, 0.0F, 255.0F) + 0.5F);
  };
  return {level(c.x()), level(c.y()), level(c.z())};
}

Eigen::Vector3f levels(const Rgb& c) {
  return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
}

/// Where in a triangle is looked, as shares of its corners.
constexpr std::array<std::array<float, 3>, 4> kPlaces = {
    {{0.34F, 0.33F, 0.33F}, {0.70F, 0.15F, 0.15F}, {0.15F, 0.70F, 0.15F}, {0.15F, 0.15F, 0.70F}}};

/// The colour there; nothing: a hole.
std::optional<Rgb> color_at(const ScenePart& part, const std::array<std::uint32_t, 3>& t,
                            const std::array<float, 3>& share) {
  const auto mixed = [&](const auto& corner) {
    return (share[0] * corner(t[0]) + share[1] * corner(t[1]) + share[2] * corner(t[2])).eval();
  };
  if (part.texture != nullptr && part.uv.size() == part.mesh.vertices.size()) {
    const Eigen::Vector2f uv = mixed([&](std::uint32_t i) { return part.uv[i]; });
    if (!part.texture->solid_at(uv)) return std::nullopt;
    if (!part.texture->color.empty()) return rounded(part.texture->color_at(uv));
  }
  if (part.vertex_colors.empty()) return part.color;
  return rounded(mixed([&](std::uint32_t i) { return levels(part.vertex_colors[i]); }));
}

void add_part(const ScenePart& part, Sample* sample) {
  const auto& triangles = part.mesh.triangles;
  const std::size_t step = triangles.size() / kMostTriangles + 1;
  for (std::size_t i = 0; i < triangles.size(); i += step) {
    const auto& t = triangles[i];
    const Eigen::Vector3f a = part.mesh.vertices[t[0]];
    const Eigen::Vector3f b = part.mesh.vertices[t[1]] - a;
    const Eigen::Vector3f c = part.mesh.vertices[t[2]] - a;
    const double area = 0.5 * static_cast<double>(b.cross(c).norm()) * static_cast<double>(step);
    for (const auto& place : kPlaces) {
      const auto color = color_at(part, t, place);
      if (!color) continue;
      sample->colors.push_back(*color);
      sample->areas.push_back(area / kPlaces.size());
    }
  }
}

bool grey(const Rgb& c) {
  const int high = std::max({c.r, c.g, c.b});
  const int low = std::min({c.r, c.g, c.b});
  return high - low <= kGrey * high;
}

std::map<int, Sample> samples_of(const Scene& scene) {
  std::map<int, Sample> samples;
  scene.for_each_part([&](const ScenePart& part, const Pose&, const SceneInstance* copy) {
    if (part.fruit < 0) return;
    const int id = part.fruit + (copy != nullptr ? copy->first_fruit : 0);
    if (scene.fruits[static_cast<std::size_t>(id)].counted) add_part(part, &samples[id]);
  });
  return samples;
}

}  // namespace

FruitColors look_at_fruits(const Scene& scene, const ColorDetectorOptions& detector) {
  FruitColors result;
  double surface = 0.0;
  for (const auto& [id, sample] : samples_of(scene)) {
    const std::vector<bool> in = in_color_windows(sample.colors, detector);
    double whole = 0.0;
    double passing = 0.0;
    double colorless = 0.0;
    for (std::size_t i = 0; i < in.size(); ++i) {
      whole += sample.areas[i];
      if (in[i]) passing += sample.areas[i];
      if (grey(sample.colors[i])) colorless += sample.areas[i];
    }
    ++result.counted;
    if (whole > 0.0 && passing >= kSeenShare * whole) ++result.seen;
    if (colorless >= (1.0 - kSeenShare) * whole) ++result.colorless;
    result.passing += passing;
    surface += whole;
  }
  if (surface > 0.0) result.passing /= surface;
  return result;
}

std::optional<std::string> fruit_color_notice(const Scene& scene,
                                              const ColorDetectorOptions& detector) {
  const FruitColors colors = look_at_fruits(scene, detector);
  if (2 * colors.seen >= colors.counted) return std::nullopt;
  std::array<char, 256> numbers{};
  std::snprintf(
      numbers.data(), numbers.size(),
      "of %d fruits that count, the detector 'colour' can see %d: %.1f %% of their surface "
      "has a colour it looks for",
      colors.counted, colors.seen, 100.0 * colors.passing);
  std::string text = numbers.data();
  if (colors.colorless > 0) {
    text += ", and " + std::to_string(colors.colorless) +
            " fruits are grey or white (is a texture missing?)";
  }
  return text +
         "; give the fruits their colour, set the mission's detector to their hue "
         "(detector.windows), or take 'detector.kind: labels'";
}

}  // namespace canopeer
