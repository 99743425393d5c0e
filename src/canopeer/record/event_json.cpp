#include "canopeer/record/event_json.h"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

namespace canopeer::event_json {
namespace {

Json from(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json from(const Box& box) { return Json::array({from(box.min()), from(box.max())}); }

/// The upper three rows of the matrix, row by row: exact, unlike a quaternion.
Json from(const Pose& pose) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) rows.push_back(pose.matrix()(row, column));
  }
  return rows;
}

Vec3 to_vec3(const Json& json) {
  return {to_number(json.at(0)), to_number(json.at(1)), to_number(json.at(2))};
}

Box to_box(const Json& json) { return {to_vec3(json.at(0)), to_vec3(json.at(1))}; }

Pose to_pose(const Json& json) {
  Pose pose = Pose::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      pose.matrix()(row, column) = to_number(json.at(static_cast<std::size_t>(4 * row + column)));
    }
  }
  return pose;
}

std::vector<double> to_numbers(const Json& json) {
  std::vector<double> numbers;
  for (const Json& entry : json) numbers.push_back(to_number(entry));
  return numbers;
}

}  // namespace

double to_number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json from(const RunHeader& header) {
  Json settings = Json::parse(header.settings_json, nullptr, false);
  // Text that is no JSON is kept as it is rather than lost.
  if (settings.is_discarded()) settings = header.settings_json;
  Json json = {{"canopeer_record", kFormatVersion},
               {"canopeer_version", header.canopeer_version},
               {"mission", header.mission},
               {"planner", header.planner},
               {"seed", header.seed},
               {"compute_table", header.compute_table},
               {"segments", header.segments},
               {"segment_time_s", header.segment_time_s},
               {"settings", std::move(settings)}};
  if (header.mission_time_s > 0.0) json["mission_time_s"] = header.mission_time_s;
  if (!header.protocol.empty()) json["protocol"] = header.protocol;
  if (header.views_planned > 0) json["views_planned"] = header.views_planned;
  return json;
}

RunHeader to_header(const Json& json) {
  RunHeader header;
  header.canopeer_version = json.at("canopeer_version").get<std::string>();
  header.mission = json.at("mission").get<std::string>();
  header.planner = json.at("planner").get<std::string>();
  header.seed = json.at("seed").get<std::uint64_t>();
  header.compute_table = json.at("compute_table").get<std::string>();
  header.segments = json.at("segments").get<int>();
  header.segment_time_s = to_number(json.at("segment_time_s"));
  if (json.contains("mission_time_s")) header.mission_time_s = to_number(json["mission_time_s"]);
  header.protocol = json.value("protocol", header.protocol);
  header.views_planned = json.value("views_planned", header.views_planned);
  const Json& settings = json.at("settings");
  header.settings_json = settings.is_string() ? settings.get<std::string>() : settings.dump();
  return header;
}

Json from(const SegmentEvent& segment) {
  return {{"segment", segment.segment},
          {"name", segment.name},
          {"start_s", segment.start_s},
          {"sampling_region_world", from(segment.sampling_region_world)},
          {"workspace_world", from(segment.workspace_world)}};
}

SegmentEvent to_segment(const Json& json) {
  SegmentEvent segment;
  segment.segment = json.at("segment").get<int>();
  segment.name = json.at("name").get<std::string>();
  segment.start_s = to_number(json.at("start_s"));
  segment.sampling_region_world = to_box(json.at("sampling_region_world"));
  segment.workspace_world = to_box(json.at("workspace_world"));
  return segment;
}

namespace {

Json from(const FruitSnapshot& fruit) {
  return Json::array({fruit.id, fruit.centre.x(), fruit.centre.y(), fruit.centre.z(),
                      fruit.volume_cm3, fruit.confidence});
}

FruitSnapshot to_fruit(const Json& fruit) {
  return {fruit.at(0).get<int>(),
          Vec3(to_number(fruit.at(1)), to_number(fruit.at(2)), to_number(fruit.at(3))),
          to_number(fruit.at(4)), fruit.size() > 5 ? to_number(fruit.at(5)) : 0.0};
}

Json from(const std::optional<PixelHits>& pixels) {
  Json json;
  if (pixels) json = {pixels->right, pixels->wrong, pixels->missed};
  return json;
}

std::optional<PixelHits> to_pixels(const Json& json) {
  const auto pixels = json.find("pixels");
  if (pixels == json.end() || pixels->is_null()) return std::nullopt;
  return PixelHits{pixels->at(0).get<std::int64_t>(), pixels->at(1).get<std::int64_t>(),
                   pixels->at(2).get<std::int64_t>()};
}

bool same(const FruitSnapshot& a, const FruitSnapshot& b) {
  return a.id == b.id && a.centre == b.centre && a.volume_cm3 == b.volume_cm3 &&
         a.confidence == b.confidence;
}

/// By ascending id, as fruits are listed.
const FruitSnapshot* find(const std::vector<FruitSnapshot>& fruits, int id) {
  const auto at = std::lower_bound(fruits.begin(), fruits.end(), id,
                                   [](const FruitSnapshot& f, int i) { return f.id < i; });
  return at != fruits.end() && at->id == id ? &*at : nullptr;
}

}  // namespace

Json from(const ViewEvent& view) {
  Json fruits = Json::array();
  for (const FruitSnapshot& fruit : view.fruits) fruits.push_back(from(fruit));
  Json pixels = from(view.pixels);
  Json json = {{"segment", view.segment},
               {"view", view.view},
               {"t_s", view.t_s},
               {"planning_s", view.planning_s},
               {"motion_s", view.motion_s},
               {"q", view.q},
               {"T_world_camera", from(view.T_world_camera)},
               {"target_kind", view.target_kind},
               {"predicted_gain", view.predicted_gain ? Json(*view.predicted_gain) : Json(nullptr)},
               {"realised_gain", view.realised_gain},
               {"fused_points", view.fused_points},
               {"roi_voxels", view.roi_voxels},
               {"pixels", std::move(pixels)},
               {"graph_nodes", view.graph_nodes},
               {"graph_edges", view.graph_edges},
               {"fruits", std::move(fruits)}};
  if (view.realised_in_fan) json["realised_in_fan"] = *view.realised_in_fan;
  return json;
}

ViewEvent to_view(const Json& json) {
  ViewEvent view;
  view.segment = json.at("segment").get<int>();
  view.view = json.at("view").get<int>();
  view.t_s = to_number(json.at("t_s"));
  view.planning_s = to_number(json.at("planning_s"));
  view.motion_s = to_number(json.at("motion_s"));
  view.q = to_numbers(json.at("q"));
  view.T_world_camera = to_pose(json.at("T_world_camera"));
  view.target_kind = json.at("target_kind").get<std::string>();
  const Json& predicted = json.at("predicted_gain");
  if (!predicted.is_null()) view.predicted_gain = predicted.get<double>();
  view.realised_gain = json.at("realised_gain").get<std::int64_t>();
  view.fused_points = json.at("fused_points").get<std::int64_t>();
  view.roi_voxels = json.at("roi_voxels").get<std::int64_t>();
  view.graph_nodes = json.at("graph_nodes").get<int>();
  view.graph_edges = json.at("graph_edges").get<int>();
  for (const Json& fruit : json.at("fruits")) view.fruits.push_back(to_fruit(fruit));
  view.pixels = to_pixels(json);
  if (const auto gain = json.find("realised_in_fan"); gain != json.end()) {
    view.realised_in_fan = gain->get<std::int64_t>();
  }
  return view;
}

Json from(const FrameEvent& frame, const std::vector<FruitSnapshot>& before) {
  Json fresh = Json::array();
  for (const FruitSnapshot& fruit : frame.fruits) {
    const FruitSnapshot* const old = find(before, fruit.id);
    if (old == nullptr || !same(*old, fruit)) fresh.push_back(from(fruit));
  }
  Json gone = Json::array();
  for (const FruitSnapshot& fruit : before) {
    if (find(frame.fruits, fruit.id) == nullptr) gone.push_back(fruit.id);
  }
  return {{"segment", frame.segment},
          {"during", frame.during},
          {"t_s", frame.t_s},
          {"T_world_camera", from(frame.T_world_camera)},
          {"blur_px", frame.blur_px},
          {"realised_gain", frame.realised_gain},
          {"fused_points", frame.fused_points},
          {"pixels", from(frame.pixels)},
          {"fruits_changed", std::move(fresh)},
          {"fruits_gone", std::move(gone)}};
}

FrameEvent to_frame(const Json& json, const std::vector<FruitSnapshot>& before) {
  FrameEvent frame;
  frame.segment = json.at("segment").get<int>();
  frame.during = json.at("during").get<std::string>();
  frame.t_s = to_number(json.at("t_s"));
  frame.T_world_camera = to_pose(json.at("T_world_camera"));
  frame.blur_px = to_number(json.at("blur_px"));
  frame.realised_gain = json.at("realised_gain").get<std::int64_t>();
  frame.fused_points = json.at("fused_points").get<std::int64_t>();
  frame.pixels = to_pixels(json);
  std::map<int, FruitSnapshot> fruits;
  for (const FruitSnapshot& fruit : before) fruits[fruit.id] = fruit;
  for (const Json& id : json.at("fruits_gone")) fruits.erase(id.get<int>());
  for (const Json& entry : json.at("fruits_changed")) {
    const FruitSnapshot fruit = to_fruit(entry);
    fruits[fruit.id] = fruit;
  }
  for (const auto& [id, fruit] : fruits) frame.fruits.push_back(fruit);
  return frame;
}

Json from(const MotionEvent& motion) {
  Json json = {{"kind", motion.kind},           {"segment", motion.segment},
               {"start_s", motion.start_s},     {"duration_s", motion.duration_s},
               {"waypoints", motion.waypoints}, {"joint_path_rad", motion.joint_path_rad},
               {"collision", motion.collision}, {"plant_contact", motion.plant_contact}};
  if (!motion.deviations.empty()) json["deviations"] = motion.deviations;
  if (motion.ended != MotionEvent().ended) json["ended"] = motion.ended;
  if (!motion.why.empty()) json["why"] = motion.why;
  if (!motion.trolley.empty()) json["trolley"] = motion.trolley;
  if (const auto& frames = motion.frames) {
    json["frames"] = {{"fused", frames->fused},
                      {"late", frames->late},
                      {"blurred", frames->blurred},
                      {"alike", frames->alike},
                      {"unread", frames->unread}};
  }
  if (motion.camera_path_m) json["camera_path_m"] = *motion.camera_path_m;
  return json;
}

MotionEvent to_motion(const Json& json) {
  MotionEvent motion;
  motion.kind = json.at("kind").get<std::string>();
  motion.segment = json.at("segment").get<int>();
  motion.start_s = to_number(json.at("start_s"));
  motion.duration_s = to_number(json.at("duration_s"));
  for (const Json& q : json.at("waypoints")) motion.waypoints.push_back(to_numbers(q));
  if (json.contains("deviations")) motion.deviations = to_numbers(json.at("deviations"));
  motion.joint_path_rad = to_number(json.at("joint_path_rad"));
  motion.collision = json.at("collision").get<bool>();
  motion.plant_contact = json.at("plant_contact").get<bool>();
  motion.ended = json.value("ended", motion.ended);
  motion.why = json.value("why", motion.why);
  if (json.contains("trolley")) motion.trolley = to_numbers(json.at("trolley"));
  if (const auto frames = json.find("frames"); frames != json.end()) {
    motion.frames = FrameCounts{frames->at("fused").get<int>(), frames->at("late").get<int>(),
                                frames->at("blurred").get<int>(), frames->at("alike").get<int>(),
                                frames->at("unread").get<int>()};
  }
  if (json.contains("camera_path_m")) motion.camera_path_m = to_number(json.at("camera_path_m"));
  return motion;
}

Json from(const SteeringEvent& steering) {
  return {{"t_s", steering.t_s},
          {"segment", steering.segment},
          {"said", steering.said},
          {"by", steering.by},
          {"why", steering.why}};
}

SteeringEvent to_steering(const Json& json) {
  return {to_number(json.at("t_s")), json.at("segment").get<int>(),
          json.at("said").get<std::string>(), json.at("by").get<std::string>(),
          json.at("why").get<std::string>()};
}

Json from(const FaultEvent& fault) { return {{"t_s", fault.t_s}, {"message", fault.message}}; }

FaultEvent to_fault(const Json& json) {
  return {to_number(json.at("t_s")), json.at("message").get<std::string>()};
}

Json from(const std::vector<WorkItem>& work) {
  Json items = Json::array();
  for (const WorkItem& item : work) {
    items.push_back({{"name", item.name}, {"count", item.count}, {"seconds", item.seconds}});
  }
  return items;
}

std::vector<WorkItem> to_work(const Json& json) {
  std::vector<WorkItem> work;
  for (const Json& item : json) {
    work.push_back({item.at("name").get<std::string>(), item.at("count").get<std::int64_t>(),
                    to_number(item.at("seconds"))});
  }
  return work;
}

Json from(const TimeSplit& time) {
  return {{"mapping_s", time.mapping_s},
          {"planning_s", time.planning_s},
          {"execution_s", time.execution_s},
          {"waiting_s", time.waiting_s},
          {"transitions_s", time.transitions_s}};
}

TimeSplit to_time(const Json& json) {
  return {to_number(json.at("mapping_s")), to_number(json.at("planning_s")),
          to_number(json.at("execution_s")), to_number(json.at("waiting_s")),
          to_number(json.at("transitions_s"))};
}

std::string reason(const std::exception& exception) {
  const std::string text = exception.what();
  const std::size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace canopeer::event_json
