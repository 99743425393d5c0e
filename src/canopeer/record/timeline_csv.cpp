#include "canopeer/record/timeline_csv.h"

#include <fmt/format.h>

namespace canopeer {

std::string timeline_csv(const RunRecord& record) {
  std::string csv =
      "t_s,segment,view,planning_s,motion_s,fused_points,fruits_found,target_kind,predicted_gain,"
      "realised_gain,roi_voxels,graph_nodes,graph_edges,x_m,y_m,z_m,pixel_precision,pixel_recall,"
      "pixel_iou\n";
  for (const ViewEvent& view : record.views) {
    const Vec3 camera = view.T_world_camera.translation();
    const std::string predicted =
        view.predicted_gain ? fmt::format("{:.1f}", *view.predicted_gain) : std::string();
    const std::string pixels = view.pixels
                                   ? fmt::format("{:.4f},{:.4f},{:.4f}", view.pixels->precision(),
                                                 view.pixels->recall(), view.pixels->iou())
                                   : std::string(",,");
    csv += fmt::format(
        "{:.3f},{},{},{:.3f},{:.3f},{},{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{}\n", view.t_s,
        view.segment, view.view, view.planning_s, view.motion_s, view.fused_points,
        view.fruits.size(), view.target_kind, predicted, view.realised_gain, view.roi_voxels,
        view.graph_nodes, view.graph_edges, camera.x(), camera.y(), camera.z(), pixels);
  }
  return csv;
}

}  // namespace canopeer
