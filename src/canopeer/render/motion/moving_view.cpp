#include "canopeer/render/motion/moving_view.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "canopeer/render/motion/image_motion.h"
#include "canopeer/render/motion/linear_light.h"
#include "canopeer/render/motion/shutter.h"
#include "canopeer/render/surfaces/pixel_hash.h"

namespace canopeer {
namespace {

std::size_t index_of(int i) { return static_cast<std::size_t>(i); }

/// The rows that anybody asks for of a sub-frame.
struct SubFrame {
  RenderedView view;
  int first_row = 0;

  [[nodiscard]] int row(int v) const { return v - first_row; }
};

/// What each row sees.
struct Rows {
  std::vector<RowExposure> color;
  std::vector<RowExposure> depth;

  Rows(const Shutter& shutter, int rows) {
    for (int v = 0; v < rows; ++v) {
      color.push_back(shutter.color_row(v));
      depth.push_back(shutter.depth_row(v));
    }
  }
  /// The first and the last row that see sub-frame `i`.
  [[nodiscard]] std::pair<int, int> that_see(int i) const {
    const auto sees = [&](const RowExposure& row) { return i >= row.first && i <= row.last(); };
    std::pair<int, int> found{0, -1};
    for (std::size_t v = 0; v < color.size(); ++v) {
      if (!sees(color[v]) && !sees(depth[v])) continue;
      if (found.second < 0) found.first = static_cast<int>(v);
      found.second = static_cast<int>(v);
    }
    return found;
  }
};

/// Renders what anybody sees of a sub-frame. Behind a lens all of it: where the pixels of a part
/// look would have to be reckoned anew.
SubFrame render_rows(const Renderer& renderer, const CameraRays& rays, const Pose& T_world_camera,
                     std::pair<int, int> rows) {
  CameraIntrinsics part = rays.intrinsics();
  if (!rays.lens().none() || rows.second < 0) return {renderer.render(rays, T_world_camera), 0};
  part.height = rows.second - rows.first + 1;
  part.cy -= rows.first;
  return {renderer.render(part, T_world_camera), rows.first};
}

/// One image of sub-frames, row by row.
class Exposure {
 public:
  Exposure(const std::vector<SubFrame>& frames, const Rows& rows, double edge_step,
           std::uint64_t key)
      : frames_(frames), rows_(rows), edge_step_(edge_step), key_(key) {}

  void expose(int v, RenderedView* out) const {
    const RowExposure& color = rows_.color[index_of(v)];
    expose_color(v, color, &out->color);
    const SubFrame& middle = frames_[index_of(color.middle)];
    for (int u = 0; u < out->color.width(); ++u) {
      out->labels.fruit.at(u, v) = middle.view.labels.fruit.at(u, middle.row(v));
      out->labels.kind.at(u, v) = middle.view.labels.kind.at(u, middle.row(v));
    }
    const RowExposure& depth = rows_.depth[index_of(v)];
    for (int u = 0; u < out->depth.width(); ++u) out->depth.at(u, v) = depth_of(u, v, depth);
  }

 private:
  void expose_color(int v, const RowExposure& row, ColorImage* out) const {
    const LinearLight& light = linear_light();
    const auto width = index_of(out->width());
    std::vector<std::uint32_t> sum(3 * width, RowExposure::kWhole / 2);  // so that it rounds
    for (std::size_t i = 0; i < row.shares.size(); ++i) {
      const std::uint32_t share = row.shares[i];
      const SubFrame& frame = frames_[index_of(row.first) + i];
      const Rgb* seen = &frame.view.color.at(0, frame.row(v));
      for (std::size_t u = 0; u < width; ++u) {
        sum[3 * u] += share * light.of(seen[u].r);
        sum[3 * u + 1] += share * light.of(seen[u].g);
        sum[3 * u + 2] += share * light.of(seen[u].b);
      }
    }
    const auto value = [&](std::size_t i) {
      return light.value(static_cast<std::uint16_t>(sum[i] / RowExposure::kWhole));
    };
    Rgb* pixels = &out->at(0, v);
    for (std::size_t u = 0; u < width; ++u) {
      pixels[u] = {value(3 * u), value(3 * u + 1), value(3 * u + 2)};
    }
  }

  float depth_of(int u, int v, const RowExposure& row) const {
    const auto depth = [&](int i) {
      const SubFrame& frame = frames_[index_of(i)];
      return frame.view.depth.at(u, frame.row(v));
    };
    float near = depth(row.middle);
    float far = near;
    for (int i = row.first; i <= row.last(); ++i) {
      near = std::min(near, depth(i));
      far = std::max(far, depth(i));
    }
    // 0 is nothing: whatever else was seen is apart from it.
    const double step = static_cast<double>(far) - static_cast<double>(near);
    if (step <= edge_step_ * static_cast<double>(near)) return depth(row.middle);
    const auto pixel = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) << 32) |
                       static_cast<std::uint32_t>(u);
    auto drawn = static_cast<std::uint32_t>(pixel_hash(key_ ^ pixel) >> 48);
    static_assert(RowExposure::kWhole == 1U << 16);
    int i = row.first;
    for (const std::uint32_t share : row.shares) {
      if (drawn < share) break;
      drawn -= share;
      ++i;
    }
    return depth(i);
  }

  const std::vector<SubFrame>& frames_;
  const Rows& rows_;
  double edge_step_;
  std::uint64_t key_;
};

}  // namespace

RenderedView render_moving(const Renderer& renderer, const CameraRays& rays,
                           const CameraTrack& track, double t_s, const CameraMotionOptions& motion,
                           double edge_step, std::uint64_t key) {
  const Pose T_world_camera = track(t_s);
  RenderedView middle = renderer.render(rays, T_world_camera);
  const double window_s = motion.exposure_s + motion.readout_s;
  if (window_s <= 0.0) return middle;
  const double moved_px = image_motion(middle.depth, rays, track(t_s - window_s / 2.0),
                                       T_world_camera, track(t_s + window_s / 2.0));
  const int count = sub_frames_for(moved_px, motion.sub_frames);
  if (count == 1) return middle;

  const Shutter shutter(motion, middle.depth.height(), count);
  const Rows rows(shutter, middle.depth.height());
  RenderedView out = middle;
  std::vector<SubFrame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(i == count / 2 ? SubFrame{std::move(middle), 0}
                                    : render_rows(renderer, rays, track(t_s + shutter.time_s(i)),
                                                  rows.that_see(i)));
  }
  const Exposure exposure(frames, rows, edge_step, pixel_hash(key ^ 0x626c7572ULL));
  oneapi::tbb::parallel_for(0, out.depth.height(), [&](int v) { exposure.expose(v, &out); });
  return out;
}

}  // namespace canopeer
