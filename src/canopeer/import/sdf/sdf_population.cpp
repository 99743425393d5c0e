#include "canopeer/import/sdf/sdf_population.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "canopeer/base/rng.h"
#include "canopeer/import/sdf/sdf_numbers.h"

namespace canopeer {
namespace {

constexpr double kMost = 10000.0;  // models of one population

/// A box about the origin, or a cylinder that stands on it, as Gazebo has them.
struct Region {
  bool cylinder = false;
  Vec3 size_m = Vec3::Ones();
  double radius_m = 0.0;

  /// The point that three numbers of [0, 1) mean: equal volumes for equal shares.
  [[nodiscard]] Vec3 at(const Vec3& u) const {
    if (!cylinder) return (u - Vec3::Constant(0.5)).cwiseProduct(size_m);
    const double radius = radius_m * std::sqrt(u.x());
    const double angle = 2.0 * std::numbers::pi * u.y();
    return {radius * std::cos(angle), radius * std::sin(angle), u.z() * size_m.z()};
  }
};

Expected<Region> region_of(const SdfElement& population) {
  Region region;
  if (const SdfElement box = population.child("box")) {
    auto size = sdf_vector(box, "size", Vec3::Ones());
    if (!size) return tl::unexpected(size.error());
    region.size_m = *size;
    return region;
  }
  const SdfElement cylinder = population.child("cylinder");
  if (!cylinder) {
    return fail(population.where() + ": <population>: expected a <box> or a <cylinder>");
  }
  region.cylinder = true;
  const auto radius = sdf_number(cylinder, "radius", 1.0);
  const auto length = sdf_number(cylinder, "length", 1.0);
  if (!radius) return tl::unexpected(radius.error());
  if (!length) return tl::unexpected(length.error());
  region.radius_m = *radius;
  region.size_m = Vec3(2.0 * *radius, 2.0 * *radius, *length);
  return region;
}

/// A whole number of 1 … kMost.
Expected<std::size_t> count_of(const SdfElement& parent, const char* tag) {
  const auto count = sdf_number(parent, tag, 1.0);
  if (!count) return tl::unexpected(count.error());
  if (!(*count >= 1.0 && *count <= kMost)) {
    return fail(parent.child(tag).where() + ": <" + tag + ">: expected 1 … " +
                std::to_string(static_cast<int>(kMost)));
  }
  return static_cast<std::size_t>(*count);
}

/// Rows along x, about the origin.
Expected<std::vector<Vec3>> grid(const SdfElement& distribution) {
  const auto rows = count_of(distribution, "rows");
  if (!rows) return tl::unexpected(rows.error());
  const auto columns = count_of(distribution, "cols");
  if (!columns) return tl::unexpected(columns.error());
  const auto step = sdf_vector(distribution, "step", Vec3(0.5, 0.5, 0.0));
  if (!step) return tl::unexpected(step.error());
  if (static_cast<double>(*rows * *columns) > kMost) {
    return fail(distribution.where() + ": <distribution>: expected rows and columns for at most " +
                std::to_string(static_cast<int>(kMost)) + " models");
  }
  const auto from_middle = [](std::size_t i, std::size_t n) {
    return static_cast<double>(i) - 0.5 * static_cast<double>(n - 1);
  };
  std::vector<Vec3> places;
  for (std::size_t row = 0; row < *rows; ++row) {
    for (std::size_t column = 0; column < *columns; ++column) {
      places.emplace_back(from_middle(column, *columns) * step->x(),
                          from_middle(row, *rows) * step->y(), 0.0);
    }
  }
  return places;
}

/// The share of the region, in [0, 1)³, that model `i` gets.
using Share = std::function<Vec3(std::size_t i)>;

/// Nothing: no such distribution.
Share share_of(const std::string& type, std::size_t count, Rng& rng) {
  if (type == "random") {
    return [&rng](std::size_t) {
      const double x = rng.uniform();
      const double y = rng.uniform();
      return Vec3(x, y, rng.uniform());
    };
  }
  if (type == "uniform") {
    // Even over the ground for any number: an additive recurrence by the plastic number's powers.
    return [&rng](std::size_t i) {
      const auto part = [i](double step) {
        const double x = 0.5 + step * static_cast<double>(i);
        return x - std::floor(x);
      };
      return Vec3(part(0.7548776662466927), part(0.5698402909980532), rng.uniform());
    };
  }
  for (const int axis : {0, 1, 2}) {
    if (type != std::string("linear-") + "xyz"[axis]) continue;
    return [axis, count](std::size_t i) {
      Vec3 u = Vec3::Constant(0.5);
      u[axis] = static_cast<double>(i) / static_cast<double>(count);
      return u;
    };
  }
  return {};
}

}  // namespace

Expected<std::vector<Vec3>> population_places(const SdfElement& population) {
  const SdfElement distribution = population.child("distribution");
  const SdfElement type = distribution.child("type");
  if (type.text() == "grid") return grid(distribution);
  const auto count = count_of(population, "model_count");
  if (!count) return tl::unexpected(count.error());
  const auto region = region_of(population);
  if (!region) return tl::unexpected(region.error());
  Rng rng(1, "population " + population.name());
  const Share share = share_of(type ? type.text() : "random", *count, rng);
  if (!share) {
    return fail(type.where() + ": <type>" + type.text() +
                ": expected random, uniform, grid, linear-x, linear-y or linear-z");
  }
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < *count; ++i) places.push_back(region->at(share(i)));
  return places;
}

}  // namespace canopeer
