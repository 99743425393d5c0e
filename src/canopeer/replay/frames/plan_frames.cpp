#include "canopeer/replay/frames/plan_frames.h"

#include <algorithm>
#include <iterator>

#include "canopeer/base/byte_order.h"
#include "canopeer/replay/frames/frame_head.h"

namespace canopeer::frames {
namespace {

/// What of the sorted `a` is not in the sorted `b`.
template <typename T>
std::vector<T> without(const std::vector<T>& a, const std::vector<T>& b) {
  std::vector<T> rest;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
  return rest;
}

std::uint8_t kind_number(TargetKind kind) {
  switch (kind) {
    case TargetKind::roi:
      return 1;
    case TargetKind::occupied:
      return 2;
    case TargetKind::border:
      return 3;
    default:
      return 0;
  }
}

void append_view(std::string& octets, const PlanSketch::View& view) {
  append_number(octets, view.id);
  const Vec3 place = view.T_world_camera.translation();
  const Vec3 direction = view.T_world_camera.linear().col(2);
  for (int i = 0; i < 3; ++i) append_number(octets, static_cast<float>(place[i]));
  for (int i = 0; i < 3; ++i) append_number(octets, static_cast<float>(direction[i]));
  append_number(octets, kind_number(view.kind));
}

}  // namespace

Frame PlanFrames::plan(const Planned& planned) {
  const PlanSketch& sketch = *planned.sketch;
  const bool fresh = planned.segment != segment_;
  if (fresh) {
    segment_ = planned.segment;
    views_.clear();
    edges_.clear();
    visited_.clear();
  }
  std::vector<EdgeIds> edges;
  edges.reserve(sketch.edges.size());
  for (const PlanSketch::Edge& edge : sketch.edges) edges.emplace_back(edge.a, edge.b);
  std::sort(edges.begin(), edges.end());
  std::vector<std::int32_t> visited;
  std::string octets;
  int new_views = 0;
  for (const PlanSketch::View& view : sketch.views) {
    if (view.visited) visited.push_back(view.id);
    const auto [told, is_new] = views_.try_emplace(view.id, view.kind);
    if (!is_new && told->second == view.kind) continue;
    told->second = view.kind;
    append_view(octets, view);
    ++new_views;
  }
  // Both ascend.
  std::vector<std::int32_t> gone_views;
  auto present = sketch.views.begin();
  for (auto told = views_.begin(); told != views_.end();) {
    while (present != sketch.views.end() && present->id < told->first) ++present;
    if (present != sketch.views.end() && present->id == told->first) {
      ++told;
    } else {
      gone_views.push_back(told->first);
      told = views_.erase(told);
    }
  }
  const std::vector<EdgeIds> new_edges = without(edges, edges_);
  const std::vector<EdgeIds> gone_edges = without(edges_, edges);
  for (const std::vector<EdgeIds>* list : {&new_edges, &gone_edges}) {
    for (const auto& [a, b] : *list) {
      append_number(octets, a);
      append_number(octets, b);
    }
  }
  for (const std::int32_t id : gone_views) append_number(octets, id);
  Json head = head_of("plan");
  head["t_s"] = from_time(planned.t_s);
  head["segment"] = planned.segment;
  head["fresh"] = fresh;
  head["views"] = new_views;
  head["edges"] = new_edges.size();
  head["gone_edges"] = gone_edges.size();
  head["gone_views"] = gone_views.size();
  head["path"] = sketch.path;
  head["at"] = sketch.at ? Json(*sketch.at) : Json(nullptr);
  head["visited"] = without(visited, visited_);
  edges_ = std::move(edges);
  visited_ = std::move(visited);
  return frame_of(head, std::move(octets));
}

}  // namespace canopeer::frames
