#include "canopeer/replay/run_frames.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "canopeer/base/byte_order.h"
#include "canopeer/mission/mission.h"
#include "canopeer/scene/worlds.h"
#include "canopeer/sensing/png.h"
#include "support/planning_fixture.h"

namespace canopeer {
namespace {

using Json = nlohmann::json;

/// A mission's events, all of them.
class Everything : public Watcher {
 public:
  EventNeeds needs() const override { return {true, true, true}; }
  void on_event(const Event& event) override { events.push_back(event); }
  std::vector<Event> events;
};

/// Two short segments of a simulated mission, watched; `hz` frames a second on the way.
std::vector<Event> events_of(double hz, double segment_time_s) {
  const RobotModel& robot = test::test_robot();
  const Scene scene = make_world(scenario_1_world(), 1);
  MissionOptions options;
  for (const int side : {1, 2})
    options.segments.push_back({TrolleyState{1.0, 0.0}, side, "side " + std::to_string(side)});
  options.segment_time_s = segment_time_s;
  options.costs[Work::candidate] = 1e-3;
  options.on_the_way.hz = hz;
  options.on_the_way.max_blur_px = 0.0;
  Simulation simulation(robot, scene, robot.home("side_1"), TrolleyState{1.0, 0.0}, {});
  const ArmIk ik = *ArmIk::make(robot);
  Mission mission({robot, ik, simulation.judge().checker()}, simulation.ports(), options,
                  Registries::built_in());
  simulation.watch_map(&mission.map());
  const auto all = std::make_shared<Everything>();
  mission.watch(all, {.name = "all", .wait_in_simulated_time = true});
  EXPECT_TRUE(mission.run().has_value());
  return all->events;
}

const std::vector<Event>& events_of_a_mission() {
  static const std::vector<Event> events = events_of(0.0, 5.0);
  return events;
}

RunStory story() {
  RunStory story;
  story.mission = "test";
  story.segments = {{TrolleyState{1.0, 0.0}, 1, "one"}, {TrolleyState{1.0, 0.0}, 2, "two"}};
  return story;
}

struct Parsed {
  Json head;
  std::string octets;
};

Parsed parse(const Frame& frame) {
  const std::string bytes = frame.bytes();
  const std::size_t line = bytes.find('\n');
  Parsed parsed{Json::parse(bytes.substr(0, line)), bytes.substr(line + 1)};
  EXPECT_EQ(parsed.head.at("bytes").get<std::size_t>(), parsed.octets.size());
  EXPECT_EQ(parsed.head.at("type").get<std::string>(), frame_type(bytes));
  return parsed;
}

/// What a page knows, put together again from frames as docs/live-view.md says.
struct Page {
  std::set<std::array<int, 3>> occupied;
  std::set<std::array<int, 3>> roi;
  std::set<std::array<int, 3>> targets[3];
  std::map<int, int> views;  // kinds by id
  std::set<std::pair<int, int>> edges;
  std::set<int> visited;
  std::map<int, Json> fruits;
  std::map<std::string, int> frames;

  static void set_voxels(std::set<std::array<int, 3>>& voxels, const char* block,
                         const char* mask) {
    for (int j = 0; j < 64; ++j) {
      for (int i = 0; i < 8; ++i) {
        std::array<int, 3> voxel = {i, j % 8, j / 8};
        for (int k = 0; k < 3; ++k)
          voxel[static_cast<std::size_t>(k)] += 8 * load_number<std::int32_t>(block + 4 * k);
        if ((static_cast<unsigned char>(mask[j]) >> i & 1) != 0) {
          voxels.insert(voxel);
        } else {
          voxels.erase(voxel);
        }
      }
    }
  }
  void take(const Frame& frame) {
    const auto [head, octets] = parse(frame);
    const std::string type = head.at("type");
    ++frames[type];
    const char* at = octets.data();
    if (type == "map") {
      for (int b = 0; b < head.at("blocks"); ++b, at += 140) {
        set_voxels(occupied, at, at + 12);
        set_voxels(roi, at, at + 76);
      }
    } else if (type == "targets") {
      for (int b = 0; b < head.at("blocks"); ++b, at += 204) {
        for (int kind = 0; kind < 3; ++kind) set_voxels(targets[kind], at, at + 12 + 64 * kind);
      }
    } else if (type == "plan") {
      if (head.at("fresh")) {
        views.clear();
        edges.clear();
        visited.clear();
      }
      for (int v = 0; v < head.at("views"); ++v, at += 29) views[load_number<int>(at)] = at[28];
      for (const char* list : {"edges", "gone_edges"}) {
        for (int e = 0; e < head.at(list); ++e, at += 8) {
          const std::pair<int, int> edge(load_number<int>(at), load_number<int>(at + 4));
          if (list == std::string("edges")) {
            EXPECT_TRUE(edges.insert(edge).second);
          } else {
            EXPECT_EQ(edges.erase(edge), 1U);
          }
        }
      }
      for (int v = 0; v < head.at("gone_views"); ++v, at += 4) {
        EXPECT_EQ(views.erase(load_number<int>(at)), 1U);
      }
      for (const int id : head.at("visited")) EXPECT_TRUE(visited.insert(id).second);
    } else if (type == "fruits") {
      for (const Json& fruit : head.at("changed")) fruits[fruit.at("id")] = fruit;
      for (const int id : head.at("gone")) EXPECT_EQ(fruits.erase(id), 1U);
    } else {
      return;
    }
    EXPECT_EQ(at - octets.data(), type == "fruits" ? 0 : static_cast<long>(octets.size()));
  }
};

std::set<std::array<int, 3>> voxels_of(const std::vector<VoxelIndex>& list) {
  std::set<std::array<int, 3>> voxels;
  for (const VoxelIndex& v : list) voxels.insert({v.x(), v.y(), v.z()});
  return voxels;
}

TEST(RunFrames, APageCanPutTogetherMapTargetsPlanAndFruitsAtEveryMoment) {
  RunFrames frames(story(), test::test_robot(), nullptr);
  Page page;
  for (const Event& event : events_of_a_mission()) {
    for (const Frame& frame : frames.of(event)) page.take(frame);
    if (const auto* change = std::get_if<MapChanged>(&event)) {
      std::set<std::array<int, 3>> occupied;
      std::set<std::array<int, 3>> roi;
      change->map->for_each_block([&](BlockKey key, const BlockMasks& masks) {
        for_each_voxel(key, masks.occupied, [&](const VoxelIndex& v) {
          occupied.insert({v.x(), v.y(), v.z()});
        });
        for_each_voxel(key, masks.roi, [&](const VoxelIndex& v) {
          roi.insert({v.x(), v.y(), v.z()});
        });
      });
      ASSERT_EQ(page.occupied, occupied);
      ASSERT_EQ(page.roi, roi);
      ASSERT_EQ(page.targets[0], voxels_of(change->targets->roi));
      ASSERT_EQ(page.targets[1], voxels_of(change->targets->occupied));
      ASSERT_EQ(page.targets[2], voxels_of(change->targets->border));
    }
    if (const auto* planned = std::get_if<Planned>(&event)) {
      std::map<int, int> views;
      std::set<int> visited;
      std::set<std::pair<int, int>> edges;
      for (const auto& view : planned->sketch->views) {
        views[view.id] = view.kind == TargetKind::roi        ? 1
                         : view.kind == TargetKind::occupied ? 2
                         : view.kind == TargetKind::border   ? 3
                                                             : 0;
        if (view.visited) visited.insert(view.id);
      }
      for (const auto& edge : planned->sketch->edges) edges.emplace(edge.a, edge.b);
      ASSERT_EQ(page.views, views);
      ASSERT_EQ(page.edges, edges);
      ASSERT_EQ(page.visited, visited);
    }
    if (const auto* found = std::get_if<FruitsFound>(&event)) {
      ASSERT_EQ(page.fruits.size(), found->fruits.size());
      for (const FruitEstimate& fruit : found->fruits) {
        const Json& shown = page.fruits.at(fruit.id);
        EXPECT_NEAR(shown.at("centre")[0].get<double>(), fruit.centre.x(), 1e-4);
        EXPECT_NEAR(shown.at("volume_cm3").get<double>(), fruit.volume_cm3, 0.06);
      }
    }
  }
  EXPECT_EQ(page.frames["segment"], 2);
  EXPECT_GE(page.frames["view"], 4);
  EXPECT_EQ(page.frames["picture"], 3 * page.frames["view"]);
  EXPECT_EQ(page.frames["motion"], page.frames["motion_end"]);
  EXPECT_EQ(page.frames["end"], 1);
}

TEST(RunFrames, EachFruitsPointsLieOnItsSurfaceAndAreToldOnceEach) {
  RunFrames frames(story(), test::test_robot(), nullptr);
  std::map<int, std::vector<Vec3>> points;  // by fruit
  const SurfaceMesh* mesh = nullptr;
  int told = 0;
  for (const Event& event : events_of_a_mission()) {
    for (const Frame& frame : frames.of(event)) {
      const auto [head, octets] = parse(frame);
      if (head.at("type") != "surface") continue;
      const char* at = octets.data();
      for (const Json& fruit : head.at("fruits")) {
        ++told;
        EXPECT_LE(fruit.at("points"), 400);
        auto& of_fruit = points[fruit.at("id")];
        of_fruit.clear();
        for (int i = 0; i < fruit.at("points"); ++i) {
          Vec3 p;
          for (int k = 0; k < 3; ++k, at += 2)
            p[k] = fruit.at("origin")[k].get<double>() + 1e-4 * load_number<std::int16_t>(at);
          of_fruit.push_back(p);
        }
      }
      EXPECT_EQ(at, octets.data() + octets.size());
    }
    if (const auto* end = std::get_if<RunEnded>(&event)) mesh = end->surface.get();
  }
  ASSERT_NE(mesh, nullptr);
  std::map<int, std::vector<Vec3>> surface;
  for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
    if (mesh->fruit[i] >= 0) surface[mesh->fruit[i]].push_back(mesh->vertices[i].surface.point);
  }
  ASSERT_GE(surface.size(), 1U);
  ASSERT_LE(surface.size(), points.size());
  for (const auto& [id, vertices] : surface) {
    ASSERT_TRUE(points.contains(id));
    EXPECT_EQ(points[id].size(), std::min<std::size_t>(400, vertices.size()));
    for (const Vec3& p : points[id]) {
      double nearest = 1.0;
      for (const Vec3& vertex : vertices) nearest = std::min(nearest, (vertex - p).norm());
      EXPECT_LT(nearest, 2e-4);
    }
  }
  EXPECT_LT(told, 2 * static_cast<int>(points.size()) + 1);
}

/// How many voxels the page lacks or has too many.
std::size_t beside(const Page& page, const VoxelMap& map) {
  std::size_t there = 0;
  std::size_t missing = 0;
  map.for_each_block([&](BlockKey key, const BlockMasks& masks) {
    for_each_voxel(key, masks.occupied, [&](const VoxelIndex& v) {
      ++there;
      missing += page.occupied.contains({v.x(), v.y(), v.z()}) ? 0 : 1;
    });
  });
  return missing + page.occupied.size() + missing - there;
}

TEST(RunFrames, WhatFramesOnTheWayChangeIsToldAtViewsAndEveryTwoSeconds) {
  RunFrames frames(story(), test::test_robot(), nullptr);
  Page page;
  int looks = 0;
  double behind_since_s = -1.0;
  bool at_view = false;
  std::shared_ptr<const VoxelMap> last;
  std::size_t fruits = 0;
  for (const Event& event : events_of(10.0, 3.0)) {
    for (const Frame& frame : frames.of(event)) page.take(frame);
    if (const auto* taken = std::get_if<FrameOnTheWay>(&event)) {
      at_view = false;
      ++looks;
      const Json head = parse(frames.of(event).at(0)).head;
      EXPECT_NEAR(head.at("t_s").get<double>(), taken->frame.t_s, 1e-3);
      EXPECT_NEAR(head.at("at")[2].get<double>(), taken->frame.T_world_camera(2, 3), 1e-4);
      EXPECT_NEAR(head.at("direction")[0].get<double>(), taken->frame.T_world_camera(0, 2), 1e-4);
      EXPECT_EQ(head.at("realised"), taken->frame.realised_gain);
    }
    if (std::holds_alternative<FrameTaken>(event)) at_view = true;
    if (const auto* change = std::get_if<MapChanged>(&event)) {
      last = change->map;
      if (static_cast<std::int64_t>(page.occupied.size()) == last->occupied_voxels()) {
        behind_since_s = -1.0;
      } else {
        EXPECT_FALSE(at_view);
        if (behind_since_s < 0.0) behind_since_s = change->t_s;
        EXPECT_LT(change->t_s - behind_since_s, 2.0);
      }
    }
    if (const auto* found = std::get_if<FruitsFound>(&event)) fruits = found->fruits.size();
  }
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(beside(page, *last), 0U);
  EXPECT_EQ(page.fruits.size(), fruits);
  EXPECT_GT(looks, 20);
  EXPECT_EQ(page.frames["look"], looks);
  EXPECT_LT(page.frames["map"], looks);
}

TEST(RunFrames, AfterALossTheMapIsWholeAgain) {
  RunFrames frames(story(), test::test_robot(), nullptr);
  Page page;
  int changes = 0;
  const MapChanged* last = nullptr;
  for (const Event& event : events_of_a_mission()) {
    const auto* change = std::get_if<MapChanged>(&event);
    if (change != nullptr && ++changes == 2) {
      frames.missed();  // this one is lost
      continue;
    }
    for (const Frame& frame : frames.of(event)) page.take(frame);
    if (change == nullptr) continue;
    last = change;
    ASSERT_EQ(static_cast<std::int64_t>(page.occupied.size()), change->map->occupied_voxels());
  }
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(static_cast<std::int64_t>(page.roi.size()), last->map->roi_voxels());
}

TEST(RunFrames, AMotionIsThePathThatTheArmTakes) {
  RunFrames frames(story(), test::test_robot(), nullptr);
  int motions = 0;
  for (const Event& event : events_of_a_mission()) {
    const auto* motion = std::get_if<MotionBegun>(&event);
    if (motion == nullptr) continue;
    const auto [head, octets] = parse(frames.of(event).at(0));
    const int points = head.at("points");
    const int joints = head.at("joints");
    ASSERT_EQ(octets.size(), static_cast<std::size_t>(4 * points * joints));
    for (int joint = 0; joint < joints; ++joint) {
      EXPECT_NEAR(load_number<float>(octets.data() + 4 * joint),
                  motion->path.waypoints.front()[joint], 1e-5);
      EXPECT_NEAR(load_number<float>(octets.data() + 4 * ((points - 1) * joints + joint)),
                  motion->path.waypoints.back()[joint], 1e-5);
    }
    EXPECT_NEAR((points - 1) / head.at("rate_hz").get<double>(), motion->duration_s, 1e-9);
    ++motions;
  }
  EXPECT_GT(motions, 2);
}

TEST(RunFrames, PicturesAreSmallAndReadable) {
  RunFrames frames(story(), test::test_robot(), nullptr);
  for (const Event& event : events_of_a_mission()) {
    const auto* taken = std::get_if<FrameTaken>(&event);
    if (taken == nullptr) continue;
    const std::vector<Frame> all = frames.of(event);
    ASSERT_EQ(all.size(), 4U);
    const auto [color_head, color] = parse(all[1]);
    EXPECT_EQ(color_head.at("width"), 320);
    EXPECT_EQ(color.substr(0, 3), "\xff\xd8\xff");  // JPEG
    EXPECT_LT(color.size(), 40'000U);
    const auto [depth_head, depth] = parse(all[2]);
    const auto grey = parse_png(depth);
    ASSERT_TRUE(grey.has_value());
    EXPECT_EQ(grey->width(), 160);
    // The grey value of a pixel stands for its depth, to a 254th of the range.
    const double low = depth_head.at("min_m");
    const double high = depth_head.at("max_m");
    for (int v = 0; v < 120; v += 7) {
      for (int u = 0; u < 160; u += 7) {
        const double d = static_cast<double>(taken->frame->depth.at(4 * u + 2, 4 * v + 2));
        const int value = grey->at(u, v).r;
        if (!(d > 0.0)) {
          EXPECT_EQ(value, 0);
        } else {
          EXPECT_NEAR(low + (value - 1) * (high - low) / 254.0, d, (high - low) / 254.0 + 1e-3);
        }
      }
    }
    return;
  }
  FAIL() << "no frame was taken";
}

TEST(RunFrames, TheFirstOnesHoldTheRobotAndTheTruth) {
  const Scene scene = make_world(scenario_1_world(), 1);
  const RunFrames frames(story(), test::test_robot(), &scene);
  const std::vector<Frame> first = frames.first();
  ASSERT_EQ(first.size(), 3U);
  const auto [hello, none] = parse(first[0]);
  EXPECT_EQ(hello.at("protocol"), 1);
  const auto [robot, meshes] = parse(first[1]);
  EXPECT_EQ(robot.at("links").size(), test::test_robot().links().size());
  const auto [truth, triangles] = parse(first[2]);
  EXPECT_EQ(truth.at("fruits").size(), scene.fruits.size());
  std::size_t count = 0;
  for (const Json& part : truth.at("parts")) count += part.at("triangles").get<std::size_t>();
  EXPECT_EQ(count, scene.triangle_count());
  EXPECT_EQ(triangles.size(), 12 * (count + truth.at("vertices").get<std::size_t>()));
}

/// Follows the links as a page does.
Pose pose_of(const Json& robot, std::size_t link, const Configuration& q,
             const TrolleyState& trolley) {
  const auto pose = [](const Json& rows) {
    Pose T = Pose::Identity();
    for (int i = 0; i < 12; ++i) T.matrix()(i / 4, i % 4) = rows[static_cast<std::size_t>(i)];
    return T;
  };
  const Json& json = robot.at("links")[link];
  const int parent = json.at("parent");
  Pose T = parent < 0 ? pose(robot.at("T_world_root"))
                      : pose_of(robot, static_cast<std::size_t>(parent), q, trolley);
  if (parent < 0) return T;
  T = T * pose(json.at("origin"));
  const std::string source = json.at("source");
  if (source == "still") return T;
  const double driver = source == "travel" ? trolley.travel_m
                        : source == "lift" ? trolley.lift_m
                                           : q[json.at("index").get<int>()];
  const double at = json.at("multiplier").get<double>() * driver + json.at("offset").get<double>();
  const Json& a = json.at("axis");
  const Vec3 axis(a[0], a[1], a[2]);
  if (json.at("type") == "revolute") return T * Eigen::AngleAxisd(at, axis);
  return T * Eigen::Translation3d(axis * at);
}

TEST(RunFrames, KinematicsByTheFrameAreTheRobots) {
  const RobotModel& model = test::test_robot();
  const RunFrames frames(story(), model, nullptr);
  const auto [robot, meshes] = parse(frames.first()[1]);
  const TrolleyState trolley{1.3, 0.2};
  const Configuration q = model.home("side_2");
  std::vector<Pose> links;
  model.link_poses(q, trolley, links);
  for (std::size_t i = 0; i < links.size(); ++i) {
    EXPECT_LT((pose_of(robot, i, q, trolley).matrix() - links[i].matrix()).cwiseAbs().maxCoeff(),
              1e-4)
        << model.links()[i].name;
  }
}

}  // namespace
}  // namespace canopeer
