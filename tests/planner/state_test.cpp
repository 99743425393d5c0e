#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "planner_fixture.h"

namespace canopeer {
namespace {

/// A planner and how it is set.
struct Kind {
  std::string label;
  std::string name;
  PlannerOptions options;

  /// As in another process: by a registry of its own.
  [[nodiscard]] std::unique_ptr<Planner> make() const {
    return std::move(*PlannerRegistry::built_in().make(name, options));
  }
  friend std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.label; }
};

std::vector<Kind> every_kind() {
  std::vector<Kind> kinds;
  for (const auto& name : PlannerRegistry::built_in().names()) {
    kinds.push_back({name, name, test::options_for_all()});
    // Integer programs that are solved in a moment.
    kinds.back().options.gomvp.max_views = 15;
    kinds.back().options.gomvp.neighbors = 5;
  }
  kinds.push_back({"random_walk", "vmp", {}});
  kinds.back().options.vmp.search = VmpOptions::Search::random_walk;
  kinds.push_back({"nbs_follows", "nbs", {}});
  kinds.back().options.nbs.replan_every_view = false;
  for (const auto& [label, gain] :
       {std::pair("uvc", NbvGain::uvc), std::pair("uvpc", NbvGain::uvpc),
        std::pair("oae", NbvGain::oae)}) {
    kinds.push_back({std::string("nbv_") + label, "nbv", {}});
    kinds.back().options.nbv.gain = gain;
    kinds.back().options.nbv.views = 15;
  }
  // A graph that makes room, and paths that are given up when they are old.
  kinds.push_back({"small_graph", "vmp", {}});
  kinds.back().options.vmp.builder.max_nodes = 150;
  kinds.back().options.vmp.look_ahead_rad = 100.0;
  kinds.back().options.vmp.replan_after_s = 0.3;
  // The first search when it has waited long enough for more nodes.
  kinds.push_back({"late_start", "vmp", {}});
  kinds.back().options.vmp.min_nodes = 100000;
  kinds.back().options.vmp.max_wait_s = 0.6;
  // The first search when the builder finds no more views that are new.
  kinds.push_back({"few_views", "vmp", {}});
  kinds.back().options.vmp.builder.similarity = {.position_m = 0.25, .angle_rad = 0.8};
  kinds.back().options.vmp.builder.max_idle_batches = 10;
  kinds.back().options.vmp.min_nodes = 100000;
  kinds.back().options.vmp.max_wait_s = 1000.0;
  return kinds;
}

void expect_same(const Decision& a, const Decision& b) {
  EXPECT_EQ(a.action, b.action);
  EXPECT_EQ(a.motion.waypoints, b.motion.waypoints);
  EXPECT_EQ(a.motion.T_world_camera.matrix(), b.motion.T_world_camera.matrix());
  EXPECT_EQ(a.motion.kind, b.motion.kind);
  EXPECT_EQ(a.motion.predicted_gain, b.motion.predicted_gain);
}

void expect_same(const WorkMeter& a, const WorkMeter& b) {
  for (std::size_t i = 0; i < kWorkKinds; ++i) {
    const auto kind = static_cast<Work>(i);
    EXPECT_EQ(a.units(kind), b.units(kind)) << work_name(kind);
  }
}

void expect_same(const PlannerStatus& a, const PlannerStatus& b) {
  EXPECT_EQ(a.graph_nodes, b.graph_nodes);
  EXPECT_EQ(a.graph_edges, b.graph_edges);
  EXPECT_EQ(a.searches, b.searches);
  EXPECT_EQ(a.blocked_edges, b.blocked_edges);
  EXPECT_EQ(a.off_pose_nodes, b.off_pose_nodes);
}

/// A planner whose life is cut after every call: once by a heir who takes over after each call and
/// once by a twin for each of some calls, who is there from then on. All of them must do what it
/// does.
class CutAnywhere : public Planner {
 public:
  CutAnywhere(const Kind& kind, std::set<int> cuts)
      : kind_(kind), cuts_(std::move(cuts)), planner_(kind.make()) {}

  void begin_segment(const PlanningScene& scene) override {
    scene_ = scene;
    planner_->begin_segment(scene);
    followers_.clear();
    call_ended();
  }
  void map_changed(MapChange change) override {
    // A cut between the frame and this call: the map is new already.
    const auto late = restored();
    late->map_changed(change);
    for (const auto& follower : followers_) follower->map_changed(change);
    planner_->map_changed(std::move(change));
    EXPECT_TRUE(late->state().value() == planner_->state().value());
    call_ended();
  }
  Decision decide(const Configuration& q, WorkMeter& work) override {
    WorkMeter counted;
    const Decision decision = planner_->decide(q, counted);
    for (const auto& follower : followers_) {
      WorkMeter same;
      expect_same(follower->decide(q, same), decision);
      expect_same(same, counted);
    }
    work.merge(counted);
    call_ended();
    return decision;
  }
  void grow(double budget_s, WorkMeter& work) override {
    WorkMeter counted;
    planner_->grow(budget_s, counted);
    for (const auto& follower : followers_) {
      WorkMeter same;
      follower->grow(budget_s, same);
      expect_same(same, counted);
    }
    work.merge(counted);
    call_ended();
  }

  [[nodiscard]] int calls() const { return calls_; }
  [[nodiscard]] std::size_t twins() const { return followers_.size() - 1; }

 private:
  [[nodiscard]] std::unique_ptr<Planner> restored() const {
    auto planner = kind_.make();
    const auto ok = planner->restore(scene_, last_state_);
    EXPECT_TRUE(ok.has_value()) << ok.error().message;
    return planner;
  }
  void call_ended() {
    last_state_ = planner_->state().value();
    for (const auto& follower : followers_) {
      // Not by EXPECT_EQ, which would show megabytes.
      EXPECT_TRUE(follower->state().value() == last_state_) << "after call " << calls_;
      expect_same(follower->status(), planner_->status());
    }
    auto heir = restored();
    if (followers_.empty()) {
      followers_.push_back(std::move(heir));
    } else {
      followers_.front() = std::move(heir);
    }
    if (cuts_.count(calls_++) > 0) followers_.push_back(restored());
  }

  Kind kind_;
  std::set<int> cuts_;
  std::unique_ptr<Planner> planner_;
  PlanningScene scene_;
  std::vector<std::unique_ptr<Planner>> followers_;  // the heir, then the twins
  std::string last_state_;
  int calls_ = 0;
};

class PlannerState : public ::testing::TestWithParam<Kind> {};

TEST_P(PlannerState, CutAfterAnyCallTheRunGoesOnAsIfNothingHadHappened) {
  auto made = std::make_unique<CutAnywhere>(GetParam(), std::set<int>{0, 1, 2, 4, 7, 12, 20});
  const CutAnywhere& cut = *made;
  test::PlannerFixture run(std::move(made));
  const int views = GetParam().name == "vmp_released" ? 2 : 6;  // each after many calls
  for (int view = 0; view < views; ++view) {
    ASSERT_TRUE(run.take_view()) << "view " << view;
    run.planner->grow(0.2, run.work);  // what the motion and the frame took
    ASSERT_FALSE(HasFailure()) << "view " << view;
  }
  // And from where the arm was not sent to.
  const Configuration off = run.q + Configuration::Constant(run.q.size(), 0.01);
  EXPECT_NE(run.planner->decide(off, run.work).action, Decision::Action::stuck);
  EXPECT_GE(cut.calls(), 20);
  EXPECT_GE(cut.twins(), 6U);
}

TEST_P(PlannerState, BytesThatAreNotAllThereAreRefusedAndDoNoHarm) {
  test::PlannerFixture run(GetParam().make());
  ASSERT_TRUE(run.take_view());
  const std::string state = run.planner->state().value();
  const auto planner = GetParam().make();
  EXPECT_FALSE(planner->state().has_value());  // no segment has begun
  std::vector<std::size_t> lengths = {0, 1, 7, 8, state.size() / 2, state.size() - 1};
  Rng rng(1);
  for (int i = 0; i < 20; ++i) lengths.push_back(rng.index(state.size()));
  for (const std::size_t length : lengths) {
    const auto ok = planner->restore(run.scene(), std::string_view(state).substr(0, length));
    ASSERT_FALSE(ok.has_value()) << length << " of " << state.size();
    EXPECT_NE(ok.error().message.find("not a state of this version"), std::string::npos);
  }
  EXPECT_FALSE(planner->restore(run.scene(), state + '\0').has_value());
  ASSERT_TRUE(planner->restore(run.scene(), state).has_value());
  EXPECT_TRUE(planner->state().value() == state);
}

INSTANTIATE_TEST_SUITE_P(Registry, PlannerState, ::testing::ValuesIn(every_kind()),
                         [](const auto& one) { return one.param.label; });

}  // namespace
}  // namespace canopeer
