#include "glasshouse.h"

#include "canopeer/config/robot_file.h"
#include "canopeer/render/renderer.h"
#include "support/must.h"

namespace canopeer {

Glasshouse::Glasshouse(const std::string& robot_yaml, int views)
    : FirstStop(must(load_robot(robot_yaml))) {
  const Renderer renderer(scene);
  Pose T_world_camera = frame.T_world_base * robot.T_base_camera(frame.home);
  for (int view = 0; view < views; ++view) {
    RgbdFrame seen;
    seen.intrinsics = CameraIntrinsics::from_fov(640, 480, 80.0 / 180.0 * 3.14159265358979);
    seen.T_world_camera = T_world_camera;
    RenderedView rendered = renderer.render(seen.intrinsics, seen.T_world_camera);
    seen.depth = std::move(rendered.depth);
    seen.color = std::move(rendered.color);
    targets = see(seen).change.targets;
    const auto next = draw_views(64, 100 + static_cast<std::uint64_t>(view));
    if (!next.empty()) T_world_camera = next.front().T_world_camera;
  }
}

std::vector<ViewPose> Glasshouse::draw_views(int candidates, std::uint64_t seed) const {
  const ViewSampler sampler(frame, robot, ik, {});
  const TargetSampler sampled =
      sampler.targets_in_reach(targets, perception.map().resolution_m(), {});
  std::vector<ViewPose> views;
  WorkMeter work;
  for (int i = 0; i < candidates; ++i) {
    Rng rng(seed, "glasshouse", static_cast<std::uint64_t>(i));
    if (auto view = sampler.sample(perception.map(), checker, sampled, rng, work))
      views.push_back(std::move(*view));
  }
  return views;
}

std::vector<Glasshouse::Sight> Glasshouse::draw_sights(int count, std::uint64_t seed) const {
  const TargetSampler sampled(targets, perception.map().resolution_m(), {});
  const Pose T_base_world = frame.T_world_base.inverse();
  const ViewSamplerOptions options;
  Rng rng(seed, "sights");
  std::vector<Sight> sights;
  const Box& box = frame.workspace_base;
  while (static_cast<int>(sights.size()) < count) {
    const Target target = sampled.draw(*sampled.draw_kind(rng), rng);
    const Vec3 position(rng.uniform(box.min().x(), box.max().x()),
                        rng.uniform(box.min().y(), box.max().y()),
                        rng.uniform(box.min().z(), box.max().z()));
    const Vec3 target_base = T_base_world * target.p_world;
    const double distance = (position - target_base).norm();
    if (distance >= options.min_target_distance_m && distance <= options.max_target_distance_m)
      sights.push_back({position, target_base});
  }
  return sights;
}

std::vector<Glasshouse::Edge> Glasshouse::proposed_edges(int nodes, std::uint64_t seed) const {
  ViewGraph graph;
  std::vector<Edge> edges;
  for (ViewPose& view : draw_views(40 * nodes, seed)) {
    if (graph.node_count() >= nodes) break;
    if (graph.has_similar(view, {})) continue;
    const Configuration q = view.q;
    const NodeId id = graph.add(std::move(view));
    for (const auto& neighbor : graph.nearest(q, 5, 2.0, id))
      edges.push_back({q, graph.node(neighbor.id).view.q});
  }
  return edges;
}

}  // namespace canopeer
