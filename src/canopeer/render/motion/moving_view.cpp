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

/// One image of sub-frames, row by row.
class Exposure {
 public:
  Exposure(const std::vector<RenderedView>& views, const Shutter& shutter, double edge_step,
           std::uint64_t key)
      : views_(views), shutter_(shutter), edge_step_(edge_step), key_(key) {}

  void expose(int v, RenderedView* out) const {
    const RowExposure color = shutter_.color_row(v);
    expose_color(v, color, &out->color);
    const Labels& seen = views_[index_of(color.middle)].labels;
    for (int u = 0; u < out->color.width(); ++u) {
      out->labels.fruit.at(u, v) = seen.fruit.at(u, v);
      out->labels.kind.at(u, v) = seen.kind.at(u, v);
    }
    const RowExposure depth = shutter_.depth_row(v);
    for (int u = 0; u < out->depth.width(); ++u) out->depth.at(u, v) = depth_of(u, v, depth);
  }

 private:
  void expose_color(int v, const RowExposure& row, ColorImage* out) const {
    const LinearLight& light = linear_light();
    const auto width = index_of(out->width());
    std::vector<std::uint32_t> sum(3 * width, RowExposure::kWhole / 2);  // so that it rounds
    for (std::size_t i = 0; i < row.shares.size(); ++i) {
      const std::uint32_t share = row.shares[i];
      const Rgb* seen = &views_[index_of(row.first) + i].color.at(0, v);
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
    const auto depth = [&](int i) { return views_[index_of(i)].depth.at(u, v); };
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

  const std::vector<RenderedView>& views_;
  const Shutter& shutter_;
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

  const int rows = rays.intrinsics().height;
  const Shutter shutter(motion, rows, count);
  std::vector<RenderedView> views;
  for (int i = 0; i < count; ++i) {
    views.push_back(i == count / 2 ? std::move(middle)
                                   : renderer.render(rays, track(t_s + shutter.time_s(i))));
  }
  RenderedView out = views[index_of(count / 2)];
  const Exposure exposure(views, shutter, edge_step, pixel_hash(key ^ 0x626c7572ULL));
  oneapi::tbb::parallel_for(0, rows, [&](int v) { exposure.expose(v, &out); });
  return out;
}

}  // namespace canopeer
