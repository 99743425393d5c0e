#include "canopeer/fruit/shapes/radial_rows.h"

#include <cmath>

#include "canopeer/base/log_exp.h"

namespace canopeer {
namespace {

using Lanes = FourDoubles;
constexpr int kLanes = 4;
constexpr int kChunk = ChunkedPoints::kChunk;
constexpr double kCauchySds = 3.0;  // residuals beyond so many standard deviations count little
constexpr double kTinyM = 1e-7;     // keeps logarithms finite on the body's planes of symmetry

[[gnu::always_inline]] inline Lanes root(const Lanes& square) {
  double values[kLanes];
  store_lanes(square, values);
  for (double& value : values) value = std::sqrt(value);
  return load_lanes<Lanes>(values);
}
[[gnu::always_inline]] inline Lanes size_of(const Lanes& x) {
  return doubles_of(bits_of(x) & 0x7FFFFFFFFFFFFFFF);
}
[[gnu::always_inline]] inline Lanes at_least(const Lanes& x, double low) {
  return x > low ? x : all_lanes<Lanes>(low);
}
[[gnu::always_inline]] inline Lanes at_most(const Lanes& x, double high) {
  return x < high ? x : all_lanes<Lanes>(high);
}
/// Not zero, of the same sign.
[[gnu::always_inline]] inline Lanes away(const Lanes& q) {
  return q < 0.0 ? at_most(q, -kTinyM) : at_least(q, kTinyM);
}

/// Four points at once.
[[gnu::always_inline]] inline void four_rows(const ChunkedPoints::Chunk& chunk, int at,
                                             const RadialModel& model, RadialRows& rows) {
  const FitParameters& p = model.parameters;
  const Eigen::Matrix3d& rotation = model.rotation;
  const double e1 = p[3];
  const double e2 = p[4];
  const Lanes wx = load_lanes<Lanes>(chunk.x + at) - p[5];
  const Lanes wy = load_lanes<Lanes>(chunk.y + at) - p[6];
  const Lanes wz = load_lanes<Lanes>(chunk.z + at) - p[7];
  const Lanes qx = rotation(0, 0) * wx + rotation(1, 0) * wy + rotation(2, 0) * wz;
  const Lanes qy = rotation(0, 1) * wx + rotation(1, 1) * wy + rotation(2, 1) * wz;
  const Lanes qz = rotation(0, 2) * wx + rotation(1, 2) * wy + rotation(2, 2) * wz;
  const Lanes m = root(qx * qx + qy * qy + qz * qz + kTinyM * kTinyM);
  const Lanes log_x = log_of(at_least(size_of(qx), kTinyM) / p[0]);
  const Lanes log_y = log_of(at_least(size_of(qy), kTinyM) / p[1]);
  const Lanes log_z = log_of(at_least(size_of(qz), kTinyM) / p[2]);
  const Lanes power_x = exp_of(2.0 / e2 * log_x);
  const Lanes power_y = exp_of(2.0 / e2 * log_y);
  const Lanes across = power_x + power_y;
  const Lanes log_across = log_of(across);
  const Lanes u_term = exp_of(e2 / e1 * log_across);
  const Lanes w_term = exp_of(2.0 / e1 * log_z);
  const Lanes f = u_term + w_term;
  const Lanes log_f = log_of(f);
  const Lanes inverse_gauge = exp_of(-0.5 * e1 * log_f);

  const double per_sd = 1.0 / model.surface_sd_m;
  const Lanes distance = m * (1.0 - inverse_gauge);
  const Lanes s = distance * per_sd;
  const Lanes per_cut = s / kCauchySds;
  const Lanes t = per_cut * per_cut;
  const Lanes small = t - 0.5 * (t * t) + t * (t * t) / 3.0;
  const Lanes log_1_plus_t = log_of(1.0 + t);
  const Lanes log_1_t = t < 1e-4 ? small : log_1_plus_t;
  const Lanes size = root(kCauchySds * kCauchySds * log_1_t);
  const Lanes robust = s < 0.0 ? -size : size;
  const auto put = [&](int column, const Lanes& values) __attribute__((always_inline)) {
    store_lanes(values, rows.column[column] + at);
  };
  put(RadialRows::kResidual, model.weight * robust);
  put(RadialRows::kDistance, distance);

  // dr/ds = s / (r (1 + t)), 1 at 0.
  const Lanes steep = s / ((1.0 + t) * robust);
  const Lanes slope = model.weight * per_sd * (size < 1e-9 ? all_lanes<Lanes>(1.0) : steep);
  const Lanes share_u = u_term / f;
  const Lanes share_w = w_term / f;
  const Lanes share_x = share_u * power_x / across;
  const Lanes share_y = share_u * power_y / across;
  const Lanes by_log_gauge = slope * m * inverse_gauge;
  put(0, by_log_gauge * share_x / -p[0]);
  put(1, by_log_gauge * share_y / -p[1]);
  put(2, by_log_gauge * share_w / -p[2]);
  put(3, by_log_gauge *
             (0.5 * log_f - (share_u * e2 * log_across + 2.0 * share_w * log_z) / (2.0 * e1)));
  put(4,
      by_log_gauge * 0.5 * (share_u * log_across - 2.0 / e2 * (share_x * log_x + share_y * log_y)));
  // Gradient by the point in the body's frame.
  const Lanes along = slope * (1.0 - inverse_gauge) / m;
  const Lanes gx = along * qx + by_log_gauge * share_x / away(qx);
  const Lanes gy = along * qy + by_log_gauge * share_y / away(qy);
  const Lanes gz = along * qz + by_log_gauge * share_w / away(qz);
  const Lanes cx = gy * qz - gz * qy;
  const Lanes cy = gz * qx - gx * qz;
  const Lanes cz = gx * qy - gy * qx;
  for (int k = 0; k < 3; ++k) {
    put(5 + k, -(rotation(k, 0) * gx + rotation(k, 1) * gy + rotation(k, 2) * gz));
    put(8 + k, model.turn(k, 0) * cx + model.turn(k, 1) * cy + model.turn(k, 2) * cz);
  }
}

[[gnu::always_inline]] inline void all_rows(const ChunkedPoints::Chunk& chunk,
                                            const RadialModel& model, RadialRows& rows) {
  for (int at = 0; at < kChunk; at += kLanes) four_rows(chunk, at, model, rows);
  for (int i = chunk.points; i < kChunk; ++i) {
    for (auto& column : rows.column) column[ChunkedPoints::place_in_chunk(i)] = 0.0;
  }
}

CANOPEER_WIDE void all_rows_wide(const ChunkedPoints::Chunk& chunk, const RadialModel& model,
                                 RadialRows& rows) {
  all_rows(chunk, model, rows);
}

void all_rows_narrow(const ChunkedPoints::Chunk& chunk, const RadialModel& model,
                     RadialRows& rows) {
  all_rows(chunk, model, rows);
}

/// By halves: neighbours first, the two halves of the chunk and at last odd and even points.
template <typename Product>
[[gnu::always_inline]] inline double sum_of(const Product& product) {
  const Lanes low = (product(0) + product(1)) + (product(2) + product(3));
  const Lanes high = (product(4) + product(5)) + (product(6) + product(7));
  const Lanes both = low + high;
  return (both[0] + both[2]) + (both[1] + both[3]);
}

[[gnu::always_inline]] inline void sum_products(const RadialRows& rows, NormalEquations& sum) {
  const auto at = [&](int column, int k) __attribute__((always_inline))->Lanes {
    return load_lanes<Lanes>(rows.column[column] + k * kLanes);
  };
  for (int i = 0; i <= RadialRows::kResidual; ++i) {
    for (int j = 0; j <= i; ++j) {
      sum.products(j, i) +=
          sum_of([&](int k) __attribute__((always_inline))->Lanes { return at(j, k) * at(i, k); });
    }
  }
  sum.distances_m2 += sum_of([&](int k) __attribute__((always_inline))->Lanes {
    const Lanes d = at_most(size_of(at(RadialRows::kDistance, k)), kClippedDistanceM);
    return d * d;
  });
}

CANOPEER_WIDE void sum_products_wide(const RadialRows& rows, NormalEquations& sum) {
  sum_products(rows, sum);
}

void sum_products_narrow(const RadialRows& rows, NormalEquations& sum) { sum_products(rows, sum); }

}  // namespace

ChunkedPoints::ChunkedPoints(std::span<const SurfacePoint> surface)
    : chunks_((surface.size() + kChunk - 1) / kChunk), points_(static_cast<int>(surface.size())) {
  for (std::size_t i = 0; i < surface.size(); ++i) {
    Chunk& chunk = chunks_[i / kChunk];
    const int place = place_in_chunk(static_cast<int>(i % kChunk));
    chunk.x[place] = surface[i].point.x();
    chunk.y[place] = surface[i].point.y();
    chunk.z[place] = surface[i].point.z();
    ++chunk.points;
  }
}

void radial_rows(const ChunkedPoints::Chunk& chunk, const RadialModel& model, RadialRows& rows,
                 SimdLevel level) {
  (level >= SimdLevel::avx2 ? all_rows_wide : all_rows_narrow)(chunk, model, rows);
}

void add_products(const RadialRows& rows, NormalEquations& sum, SimdLevel level) {
  (level >= SimdLevel::avx2 ? sum_products_wide : sum_products_narrow)(rows, sum);
}

}  // namespace canopeer
