#include "canopeer/replay/frames/happening_frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "canopeer/base/byte_order.h"
#include "canopeer/replay/frames/frame_head.h"
#include "canopeer/robot/path_timing.h"

namespace canopeer::frames {
namespace {

constexpr double kPointsPerSecond = 10.0;

Json joints_json(const std::vector<double>& q) {
  Json json = Json::array();
  for (const double angle : q) json.push_back(rounded(angle, 1e-5));
  return json;
}

Json fruit_json(const FruitEstimate& fruit) {
  return {{"id", fruit.id},
          {"centre", from(fruit.centre)},
          {"semi_axes", from(fruit.semi_axes_m)},
          {"e1", rounded(fruit.e1, 1e-3)},
          {"e2", rounded(fruit.e2, 1e-3)},
          {"rpy", from(fruit.roll_pitch_yaw_rad)},
          {"volume_cm3", rounded(fruit.volume_cm3, 0.1)},
          {"confidence", rounded(fruit.confidence, 1e-3)},
          {"ripeness", ripeness_name(fruit.ripeness)},
          {"color", {fruit.color.r, fruit.color.g, fruit.color.b}},
          {"points", fruit.points},
          {"views", fruit.views},
          {"seen_share", rounded(fruit.seen_share, 1e-3)},
          {"first_s", from_time(fruit.first_seen_s)},
          {"last_s", from_time(fruit.last_seen_s)}};
}

}  // namespace

Frame segment_frame(const SegmentEvent& segment, const TrolleyState& trolley) {
  Json head = head_of("segment");
  head["segment"] = segment.segment;
  head["name"] = segment.name;
  head["t_s"] = from_time(segment.start_s);
  head["region"] = from(segment.sampling_region_world);
  head["workspace"] = from(segment.workspace_world);
  head["travel"] = trolley.travel_m;
  head["lift"] = trolley.lift_m;
  return frame_of(head);
}

Frame trolley_frame(const MotionEvent& drive, const TrolleyState& there) {
  Json head = head_of("trolley");
  head["t_s"] = from_time(drive.start_s);
  head["duration_s"] = from_time(drive.duration_s);
  head["travel"] = there.travel_m;
  head["lift"] = there.lift_m;
  return frame_of(head);
}

Frame view_frame(const ViewEvent& view, const TrolleyState& trolley,
                 const CameraIntrinsics* camera) {
  Json head = head_of("view");
  head["view"] = view.view;
  head["segment"] = view.segment;
  head["t_s"] = from_time(view.t_s);
  head["q"] = joints_json(view.q);
  head["travel"] = trolley.travel_m;
  head["lift"] = trolley.lift_m;
  head["T_world_camera"] = from(view.T_world_camera);
  head["kind"] = view.target_kind;
  head["predicted"] = view.predicted_gain ? Json(*view.predicted_gain) : Json(nullptr);
  head["realised"] = view.realised_gain;
  head["points"] = view.fused_points;
  head["roi_voxels"] = view.roi_voxels;
  head["planning_s"] = from_time(view.planning_s);
  head["motion_s"] = from_time(view.motion_s);
  head["nodes"] = view.graph_nodes;
  head["edges"] = view.graph_edges;
  head["fruits"] = view.fruits.size();
  if (camera != nullptr) head["camera"] = from(*camera);
  return frame_of(head);
}

Frame look_frame(const FrameEvent& frame) {
  Json head = head_of("look");
  head["segment"] = frame.segment;
  head["t_s"] = from_time(frame.t_s);
  head["during"] = frame.during;
  head["at"] = from(Vec3(frame.T_world_camera.translation()));
  head["direction"] = from(Vec3(frame.T_world_camera.linear().col(2)));
  head["blur_px"] = rounded(frame.blur_px, 0.01);
  head["realised"] = frame.realised_gain;
  head["fruits"] = frame.fruits.size();
  return frame_of(head);
}

Frame motion_frame(const MotionBegun& motion, const RobotModel& robot) {
  const PathMotion timed(motion.path, robot);
  const int points =
      std::max(2, static_cast<int>(std::ceil(motion.duration_s * kPointsPerSecond)) + 1);
  std::string octets;
  for (int i = 0; i < points; ++i) {
    const Configuration q = timed.at(timed.duration_s() * i / (points - 1));
    for (const double angle : q) append_number(octets, static_cast<float>(angle));
  }
  Json head = head_of("motion");
  head["kind"] = motion.kind;
  head["segment"] = motion.segment;
  head["t_s"] = from_time(motion.start_s);
  head["duration_s"] = from_time(motion.duration_s);
  head["rate_hz"] = motion.duration_s > 0.0 ? (points - 1) / motion.duration_s : kPointsPerSecond;
  head["joints"] = robot.dof();
  head["points"] = points;
  return frame_of(head, std::move(octets));
}

Frame motion_end_frame(const MotionEvent& motion) {
  Json head = head_of("motion_end");
  head["t_s"] = from_time(motion.start_s + motion.duration_s);
  head["ended"] = motion.ended;
  head["why"] = motion.why;
  head["collision"] = motion.collision;
  head["plant_contact"] = motion.plant_contact;
  return frame_of(head);
}

Frame work_frame(const std::vector<WorkItem>& work) {
  Json head = head_of("work");
  head["work"] = Json::array();
  for (const WorkItem& item : work) {
    head["work"].push_back(
        {{"name", item.name}, {"count", item.count}, {"seconds", rounded(item.seconds, 1e-3)}});
  }
  return frame_of(head);
}

Frame log_frame(double t_s, std::string_view level, const std::string& text,
                std::string_view word) {
  Json head = head_of("log");
  head["t_s"] = from_time(t_s);
  head["level"] = level;
  head["text"] = text;
  if (!word.empty()) head["word"] = word;
  return frame_of(head);
}

Frame end_frame(const RunEnded& end) {
  Json head = head_of("end");
  head["t_s"] = from_time(end.end_s);
  head["interrupted"] = end.interrupted;
  return frame_of(head);
}

Frame FruitFrames::fruits(const FruitsFound& found) {
  Json head = head_of("fruits");
  head["view"] = found.view;
  head["t_s"] = from_time(found.t_s);
  head["changed"] = Json::array();
  head["gone"] = Json::array();
  std::map<int, std::string> now;
  for (const FruitEstimate& fruit : found.fruits) {
    Json json = fruit_json(fruit);
    std::string text = json.dump();
    const auto before = told_.find(fruit.id);
    if (before == told_.end() || before->second != text) head["changed"].push_back(std::move(json));
    now.emplace(fruit.id, std::move(text));
  }
  for (const auto& [id, text] : told_) {
    if (!now.contains(id)) head["gone"].push_back(id);
  }
  told_ = std::move(now);
  return frame_of(head);
}

}  // namespace canopeer::frames
