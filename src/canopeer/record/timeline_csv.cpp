#include "canopeer/record/timeline_csv.h"

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace canopeer {
namespace {

std::string text_of(const std::optional<PixelHits>& pixels) {
  if (!pixels) return ",,";
  return fmt::format("{:.4f},{:.4f},{:.4f}", pixels->precision(), pixels->recall(), pixels->iou());
}

/// Of a frame on the way: it has no view's number, no gain was predicted, no graph looked at.
std::string row_of(const FrameEvent& frame) {
  const Vec3 camera = frame.T_world_camera.translation();
  return fmt::format("{:.3f},{},,,,{},{},on the way,,{},,,,{:.4f},{:.4f},{:.4f},{}\n", frame.t_s,
                     frame.segment, frame.fused_points, frame.fruits.size(), frame.realised_gain,
                     camera.x(), camera.y(), camera.z(), text_of(frame.pixels));
}

}  // namespace

std::string timeline_csv(const RunRecord& record) {
  std::string csv =
      "t_s,segment,view,planning_s,motion_s,fused_points,fruits_found,target_kind,predicted_gain,"
      "realised_gain,roi_voxels,graph_nodes,graph_edges,x_m,y_m,z_m,pixel_precision,pixel_recall,"
      "pixel_iou\n";
  auto frame = record.frames.begin();
  const auto frames_before = [&](int view) {
    for (; frame != record.frames.end() && frame->view <= view; ++frame) csv += row_of(*frame);
  };
  for (const ViewEvent& view : record.views) {
    frames_before(view.view);
    const Vec3 camera = view.T_world_camera.translation();
    const std::string predicted =
        view.predicted_gain ? fmt::format("{:.1f}", *view.predicted_gain) : std::string();
    csv +=
        fmt::format("{:.3f},{},{},{:.3f},{:.3f},{},{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{}\n",
                    view.t_s, view.segment, view.view, view.planning_s, view.motion_s,
                    view.fused_points, view.fruits.size(), view.target_kind, predicted,
                    view.realised_gain, view.roi_voxels, view.graph_nodes, view.graph_edges,
                    camera.x(), camera.y(), camera.z(), text_of(view.pixels));
  }
  frames_before(std::numeric_limits<int>::max());
  return csv;
}

}  // namespace canopeer
