#pragma once

// The rasteriser's inner loops, written once and compiled for each instruction set. The including
// file says what they are called with CANOPEER_RASTER_NAME, and what vectors there are with its
// compile options.
//
// A triangle covers a pixel when the pixel's centre lies on the same side of all three edges. An
// edge is the plane through it and the camera. Its coefficients come from both ends in a way that
// gives exactly the negative when the ends are exchanged. So neighbours leave no gap between them,
// and nothing has to be clipped where the camera is (Olano & Greer, "Triangle scan conversion using
// 2D homogeneous coordinates", 1997). 1 / depth is linear over the picture.

#include "canopeer/render/raster/lanes.h"
#include "canopeer/render/raster/raster_kernels.h"

namespace canopeer {
namespace {

// Lanes that hold.
#if defined(__AVX512F__)
using Mask = __mmask16;
Mask at_most(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
Mask less(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
bool any(Mask m) { return m != 0; }
void write(Mask m, Floats nearness, std::uint32_t surface, float* w, std::uint32_t* id) {
  _mm512_mask_storeu_ps(w, m, nearness);
  _mm512_mask_storeu_epi32(id, m, _mm512_set1_epi32(static_cast<int>(surface)));
}
#else
using Mask = Ints;
Mask at_most(Floats a, Floats b) { return a <= b; }
Mask less(Floats a, Floats b) { return a < b; }
bool any(Mask m) {
#if defined(__AVX2__)
  return _mm256_movemask_ps(reinterpret_cast<__m256>(m)) != 0;
#elif defined(__SSE4_1__)
  return _mm_movemask_ps(reinterpret_cast<__m128>(m)) != 0;
#elif defined(__ARM_NEON)
  return vmaxvq_u32(reinterpret_cast<uint32x4_t>(m)) != 0;
#else
  std::int32_t some = 0;
  for (int i = 0; i < kLanes; ++i) some |= m[i];
  return some != 0;
#endif
}
void write(Mask m, Floats nearness, std::uint32_t surface, float* w, std::uint32_t* id) {
  store(m ? nearness : load(w), w);
  Words old;
  __builtin_memcpy(&old, id, sizeof old);
  old = m ? surface - Words{} : old;
  __builtin_memcpy(id, &old, sizeof old);
}
#endif

constexpr std::size_t kTriangles = 64;
constexpr std::size_t kVertices = 192;
constexpr float kBehind = 1e-3F;  // nearer vertices have no place in the picture, m
constexpr float kLargest = 3.402823466e38F;
constexpr float kMargin = 0.01F;  // pixels: coordinates are rounded
constexpr int kWide = 16;         // from here on rows are narrowed before pixels are looked at

/// Vertices as the camera sees them.
struct Projected {
  alignas(64) float x[kVertices], y[kVertices], z[kVertices];  // pixels · depth, depth
  alignas(64) float u[kVertices], v[kVertices], w[kVertices];  // pixels off the principal point
};

/// What filling needs of the triangles of a group.
struct Setups {
  // a · u + b · v + c of the edge opposite to each corner.
  alignas(64) float a[3][kTriangles], b[3][kTriangles], c[3][kTriangles];
  // Nearness: w0 at (u0, v0), its slopes, its bounds.
  alignas(64) float u0[kTriangles], v0[kTriangles], w0[kTriangles];
  alignas(64) float slope_u[kTriangles], slope_v[kTriangles];
  alignas(64) float w_least[kTriangles], w_most[kTriangles];
  // Pixels they can cover, inside the window; none: first > last.
  alignas(64) std::int32_t first_column[kTriangles], last_column[kTriangles];
  alignas(64) std::int32_t first_row[kTriangles], last_row[kTriangles];
  alignas(64) std::int32_t crosses[kTriangles];  // part of it is not in front of the camera
};

void project(const RasterCluster& in, Projected* out) {
  for (std::size_t i = 0; i < in.vertices; i += kLanes) {
    const Floats x = load(in.x + i) - all(in.eye[0]);
    const Floats y = load(in.y + i) - all(in.eye[1]);
    const Floats z = load(in.z + i) - all(in.eye[2]);
    const auto turned = [&](std::size_t row) {
      const float* m = in.turn + 3 * row;
      return ((all(m[0]) * x + all(m[1]) * y) + all(m[2]) * z) + all(in.shift[row]);
    };
    const Floats px = turned(0);
    const Floats py = turned(1);
    const Floats pz = turned(2);
    const Floats w = all(1.0F) / pz;
    store(px, out->x + i);
    store(py, out->y + i);
    store(pz, out->z + i);
    store(px * w, out->u + i);
    store(py * w, out->v + i);
    store(w, out->w + i);
  }
}

float least2(float a, float b) { return a < b ? a : b; }
float most2(float a, float b) { return a > b ? a : b; }
float least3(float a, float b, float c) { return least2(least2(a, b), c); }
float most3(float a, float b, float c) { return most2(most2(a, b), c); }

void edges(const RasterCluster& in, const Projected& p, Setups* s) {
  for (std::size_t k = 0; k < 3; ++k) {
    alignas(64) float px[kTriangles], py[kTriangles], pz[kTriangles];
    alignas(64) float qx[kTriangles], qy[kTriangles], qz[kTriangles];
    for (std::size_t t = 0; t < in.triangles; ++t) {
      const std::size_t from = in.corners[3 * t + (k + 1) % 3];
      const std::size_t to = in.corners[3 * t + (k + 2) % 3];
      px[t] = p.x[from], py[t] = p.y[from], pz[t] = p.z[from];
      qx[t] = p.x[to], qy[t] = p.y[to], qz[t] = p.z[to];
    }
    for (std::size_t t = 0; t < in.triangles; ++t) {
      // 2 p × q = (q − p) × (q + p): the short edge keeps its digits.
      const float ex = qx[t] - px[t], ey = qy[t] - py[t], ez = qz[t] - pz[t];
      const float sx = qx[t] + px[t], sy = qy[t] + py[t], sz = qz[t] + pz[t];
      s->a[k][t] = ey * sz - ez * sy;
      s->b[k][t] = ez * sx - ex * sz;
      s->c[k][t] = ex * sy - ey * sx;
    }
  }
}

/// Held between both, also what is not a number.
std::int32_t to_pixel(float x, float low, float high) {
  const float above = x > low ? x : low;
  return static_cast<std::int32_t>(above < high ? above : high);
}

void planes_and_bounds(const RasterCluster& in, const Projected& p, const RasterWindow& window,
                       Setups* s) {
  alignas(64) float u[3][kTriangles], v[3][kTriangles], w[3][kTriangles], z[3][kTriangles];
  for (std::size_t t = 0; t < in.triangles; ++t) {
    // The farthest corner first: its place in the picture is the surest, and so is the plane there.
    const std::uint8_t* corners = in.corners + 3 * t;
    const float w0 = p.w[corners[0]], w1 = p.w[corners[1]], w2 = p.w[corners[2]];
    const std::size_t first = w1 < w0 ? (w2 < w1 ? 2 : 1) : (w2 < w0 ? 2 : 0);
    constexpr std::uint8_t kNext[] = {0, 1, 2, 0, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = corners[kNext[first + k]];
      u[k][t] = p.u[i], v[k][t] = p.v[i], w[k][t] = p.w[i], z[k][t] = p.z[i];
    }
  }
  const auto cx = static_cast<float>(window.cx - 0.5), cy = static_cast<float>(window.cy - 0.5);
  const auto left = static_cast<float>(window.first_column);
  const auto right = static_cast<float>(window.last_column);
  const auto top = static_cast<float>(window.first_row);
  const auto bottom = static_cast<float>(window.last_row);
  for (std::size_t t = 0; t < in.triangles; ++t) {
    const float du1 = u[1][t] - u[0][t], dv1 = v[1][t] - v[0][t], dw1 = w[1][t] - w[0][t];
    const float du2 = u[2][t] - u[0][t], dv2 = v[2][t] - v[0][t], dw2 = w[2][t] - w[0][t];
    const float by_area = 1.0F / (du1 * dv2 - du2 * dv1);
    s->u0[t] = u[0][t];
    s->v0[t] = v[0][t];
    s->w0[t] = w[0][t];
    s->slope_u[t] = (dw1 * dv2 - dw2 * dv1) * by_area;
    s->slope_v[t] = (du1 * dw2 - du2 * dw1) * by_area;
    s->w_least[t] = least3(w[0][t], w[1][t], w[2][t]);
    s->w_most[t] = most3(w[0][t], w[1][t], w[2][t]);
    // In columns and rows: pixel i has its centre at i.
    const float x_low = (least3(u[0][t], u[1][t], u[2][t]) + cx) - kMargin;
    const float x_high = (most3(u[0][t], u[1][t], u[2][t]) + cx) + kMargin;
    const float y_low = (least3(v[0][t], v[1][t], v[2][t]) + cy) - kMargin;
    const float y_high = (most3(v[0][t], v[1][t], v[2][t]) + cy) + kMargin;
    // Beyond the window first > last: both ends are held a pixel outside of it.
    s->first_column[t] = to_pixel(__builtin_ceilf(x_low), left, right + 1.0F);
    s->last_column[t] = to_pixel(__builtin_floorf(x_high), left - 1.0F, right);
    s->first_row[t] = to_pixel(__builtin_ceilf(y_low), top, bottom + 1.0F);
    s->last_row[t] = to_pixel(__builtin_floorf(y_high), top - 1.0F, bottom);
    s->crosses[t] = least3(z[0][t], z[1][t], z[2][t]) <= kBehind ? 1 : 0;
  }
}

/// A triangle that reaches behind the camera: it may be anywhere in the picture, and its plane is
/// reckoned from its points in space. False when it cannot be seen.
bool set_up_crossing(const RasterCluster& in, const Projected& p, const RasterWindow& window,
                     std::size_t t, Setups* s) {
  const auto left = static_cast<double>(window.column_centre[window.first_column]) - 1.0;
  const auto right = static_cast<double>(window.column_centre[window.last_column]) + 1.0;
  const double top = window.first_row - window.cy - 0.5;
  const double bottom = window.last_row - window.cy + 1.5;
  double x[3], y[3], z[3];
  int behind[5] = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = in.corners[3 * t + k];
    x[k] = p.x[i], y[k] = p.y[i], z[k] = p.z[i];
    behind[0] += x[k] < left * z[k];
    behind[1] += x[k] > right * z[k];
    behind[2] += y[k] < top * z[k];
    behind[3] += y[k] > bottom * z[k];
    behind[4] += z[k] <= 0.0;
  }
  for (const int corners : behind) {
    if (corners == 3) return false;
  }
  const double e[3] = {x[1] - x[0], y[1] - y[0], z[1] - z[0]};
  const double f[3] = {x[2] - x[0], y[2] - y[0], z[2] - z[0]};
  const double n[3] = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2],
                       e[0] * f[1] - e[1] * f[0]};
  const double distance = (n[0] * x[0] + n[1] * y[0]) + n[2] * z[0];
  if (distance == 0.0) return false;
  s->u0[t] = s->v0[t] = 0.0F;
  s->slope_u[t] = static_cast<float>(n[0] / distance);
  s->slope_v[t] = static_cast<float>(n[1] / distance);
  s->w0[t] = static_cast<float>(n[2] / distance);
  // What is behind the camera has a nearness below 0 and loses against nothing at all.
  s->w_least[t] = -kLargest;
  s->w_most[t] = kLargest;
  s->first_column[t] = window.first_column;
  s->last_column[t] = window.last_column;
  s->first_row[t] = window.first_row;
  s->last_row[t] = window.last_row;
  return true;
}

/// The edges and the nearness of one triangle in one row.
struct Row {
  float a[3];
  float r[3];  // edge i: a[i] · u + r[i]
  float slope, u0, w;
  float w_least, w_most;
};

Row row_of(const Setups& s, std::size_t t, float v) {
  Row row;
  for (std::size_t k = 0; k < 3; ++k) {
    row.a[k] = s.a[k][t];
    row.r[k] = s.b[k][t] * v + s.c[k][t];
  }
  row.slope = s.slope_u[t];
  row.u0 = s.u0[t];
  row.w = s.slope_v[t] * (v - s.v0[t]) + s.w0[t];
  row.w_least = s.w_least[t];
  row.w_most = s.w_most[t];
  return row;
}

/// Columns where all edges can have the same sign, with a pixel to spare on either side.
void narrow(const Row& row, const float* column_centre, int* first, int* last) {
  const float begin = column_centre[*first];
  const float end = column_centre[*last];
  // Both ways round: all edges ≥ 0, all edges ≤ 0.
  float low[2] = {begin, begin};
  float high[2] = {end, end};
  for (int k = 0; k < 3; ++k) {
    if (row.a[k] == 0.0F) continue;
    const float zero = -row.r[k] / row.a[k];
    const int rising = row.a[k] > 0.0F ? 0 : 1;
    low[rising] = most2(low[rising], zero - 1.0F);
    high[1 - rising] = least2(high[1 - rising], zero + 1.0F);
  }
  float from = end + 1.0F;
  float to = begin - 1.0F;
  for (int k = 0; k < 2; ++k) {
    if (low[k] > high[k]) continue;
    from = least2(from, low[k]);
    to = most2(to, high[k]);
  }
  const int start = *first;
  *first = start + static_cast<int>(most2(from - begin, 0.0F));
  const int stop = from > to ? *first - 1 : start + static_cast<int>(to - begin) + 1;
  *last = stop < *last ? stop : *last;
}

bool fill_row(const Row& row, int first, int last, std::uint32_t surface, const float* centres,
              float* nearness, std::uint32_t* surfaces) {
  bool drawn = false;
  const Floats zero{};
  const Floats end = all(centres[last]);
  const Floats a0 = all(row.a[0]), a1 = all(row.a[1]), a2 = all(row.a[2]);
  const Floats r0 = all(row.r[0]), r1 = all(row.r[1]), r2 = all(row.r[2]);
  for (int column = first; column <= last; column += kLanes) {
    const Floats u = load(centres + column);
    const Floats e0 = a0 * u + r0;
    const Floats e1 = a1 * u + r1;
    const Floats e2 = a2 * u + r2;
    const Floats low = least(least(e0, e1), e2);
    const Floats high = most(most(e0, e1), e2);
    Floats w = all(row.slope) * (u - all(row.u0)) + all(row.w);
    w = least(most(w, all(row.w_least)), all(row.w_most));
    const Mask inside = at_most(zero, low) | at_most(high, zero);
    const Mask seen = inside & at_most(u, end) & less(load(nearness + column), w);
    if (!any(seen)) continue;
    write(seen, w, surface, nearness + column, surfaces + column);
    drawn = true;
  }
  return drawn;
}

/// The same for a triangle with holes, pixel by pixel.
bool fill_row_with_holes(const Row& row, int first, int last, const RasterCluster& in,
                         std::size_t triangle, int at_row, const float* centres, float* nearness,
                         std::uint32_t* surfaces) {
  bool drawn = false;
  for (int column = first; column <= last; ++column) {
    const float u = centres[column];
    const float e0 = row.a[0] * u + row.r[0];
    const float e1 = row.a[1] * u + row.r[1];
    const float e2 = row.a[2] * u + row.r[2];
    if (least3(e0, e1, e2) < 0.0F && most3(e0, e1, e2) > 0.0F) continue;
    float w = row.slope * (u - row.u0) + row.w;
    w = w > row.w_least ? w : row.w_least;
    w = w < row.w_most ? w : row.w_most;
    if (!(w > nearness[column]) || !in.solid(in.context, triangle, column, at_row)) continue;
    nearness[column] = w;
    surfaces[column] = in.first_surface + static_cast<std::uint32_t>(triangle);
    drawn = true;
  }
  return drawn;
}

bool fill(const RasterCluster& in, const RasterWindow& window, const Setups& s, std::size_t t) {
  bool drawn = false;
  const bool wide = s.last_column[t] - s.first_column[t] >= kWide;
  const std::uint32_t surface = in.first_surface + static_cast<std::uint32_t>(t);
  for (int y = s.first_row[t]; y <= s.last_row[t]; ++y) {
    const Row row = row_of(s, t, static_cast<float>(y + 0.5 - window.cy));
    int first = s.first_column[t];
    int last = s.last_column[t];
    if (wide) narrow(row, window.column_centre, &first, &last);
    if (first > last) continue;
    const std::size_t at = static_cast<std::size_t>(y) * window.stride;
    drawn |= in.solid == nullptr
                 ? fill_row(row, first, last, surface, window.column_centre, window.nearness + at,
                            window.surface + at)
                 : fill_row_with_holes(row, first, last, in, t, y, window.column_centre,
                                       window.nearness + at, window.surface + at);
  }
  return drawn;
}

bool draw(const RasterCluster& in, const RasterWindow& window) {
  Projected projected;
  Setups setups;
  project(in, &projected);
  edges(in, projected, &setups);
  planes_and_bounds(in, projected, window, &setups);
  bool drawn = false;
  for (std::size_t t = 0; t < in.triangles; ++t) {
    if (setups.crosses[t] != 0 && !set_up_crossing(in, projected, window, t, &setups)) continue;
    if (setups.first_column[t] > setups.last_column[t]) continue;
    drawn |= fill(in, window, setups, t);
  }
  return drawn;
}

}  // namespace

extern const RasterKernels CANOPEER_RASTER_NAME;
const RasterKernels CANOPEER_RASTER_NAME = {draw};

}  // namespace canopeer
