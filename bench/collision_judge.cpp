// The fast collision check against the exact one (FCL on the real shapes) in the map of Scenario 1
// after five views. Conservative: nothing the fast check accepts may touch anything. And the price:
// how many of the motions the planner proposes it rejects though they are free.
//   collision_judge [cases, default 100000] [robot.yaml]

#include <cstdio>
#include <cstdlib>

#include "canopeer/robot/exact_checker.h"
#include "glasshouse.h"

namespace canopeer {
namespace {

constexpr double kNear = 0.02;       // m of contact
constexpr double kJudgeStep = 0.02;  // Σ|Δq| between the states of an edge that are judged

class Judge {
 public:
  explicit Judge(const Glasshouse& world)
      : world_(world),
        bare_(world.robot, world.frame.trolley, no_padding()),
        exact_(world.robot),
        rng_(1, "collision judge") {
    bare_.set_map(&world.perception.field());
  }

  /// States are held to the check without any padding: what it accepts must be free too.
  void judge_state(const Configuration& q, bool near) {
    ++cases_;
    near_ += near ? 1 : 0;
    if (!bare_.state_free(q)) return;
    ++accepted_;
    if (!exact_free(q)) ++violations_;
  }

  void random_state() { judge_state(random_configuration(), false); }

  /// A state less than 2 cm from contact: the unpadded check's boundary is within 1 cm of it.
  /// Between a free and a blocked state that boundary is halved down to, then left by no more than
  /// 1 cm for any point of the arm.
  void state_near_contact() {
    for (;;) {
      const Configuration a = random_configuration();
      Configuration b = a;
      for (double& joint : b) joint += rng_.uniform(-0.6, 0.6);
      b = b.cwiseMax(world_.robot.limits().lower).cwiseMin(world_.robot.limits().upper);
      if (!bare_free(a) || bare_free(b)) continue;
      double free = 0.0;
      double blocked = 1.0;
      while (blocked - free > 1e-6) {
        const double middle = (free + blocked) / 2.0;
        (bare_free(a + middle * (b - a)) ? free : blocked) = middle;
      }
      // No point of the arm is farther than 1.6 m from any of its axes.
      const double step = kNear / 2.0 / (1.6 * (b - a).lpNorm<1>());
      judge_state(a + std::max(0.0, free - step * rng_.uniform()) * (b - a), true);
      return;
    }
  }

  void random_edge() {
    ++cases_;
    const Configuration a = random_configuration();
    Configuration b = a;
    for (double& joint : b) joint += rng_.uniform(-0.4, 0.4);
    if (!world_.checker.edge_free(a, b)) return;
    ++accepted_;
    ++edges_;
    if (!exact_edge_free(a, b)) ++violations_;
  }

  void report_cases() const {
    std::printf(
        "cases %d (%d within %.0f mm of contact), accepted %d (%d of them edges), "
        "accepted but touching %d\n",
        cases_, near_, kNear * 1e3, accepted_, edges_, violations_);
  }

  void report_false_alarms(int nodes) {
    int proposed = 0;
    int free = 0;
    int false_alarms = 0;
    int violations = 0;
    for (const auto& [from, to] : world_.proposed_edges(nodes, 3)) {
      ++proposed;
      const bool fast = world_.checker.edge_free(from, to);
      const bool exact = exact_edge_free(from, to);
      free += exact ? 1 : 0;
      false_alarms += exact && !fast ? 1 : 0;
      violations += fast && !exact ? 1 : 0;
    }
    std::printf(
        "edges proposed %d, free by FCL without padding %d; of these rejected %d: "
        "%.1f %% of the free, %.1f %% of the proposed; accepted but touching %d\n",
        proposed, free, false_alarms, 100.0 * false_alarms / std::max(1, free),
        100.0 * false_alarms / std::max(1, proposed), violations);
  }

  [[nodiscard]] int violations() const { return violations_; }

 private:
  static CollisionOptions no_padding() {
    CollisionOptions options;
    options.map_padding_m = options.self_padding_m = 0.0;
    return options;
  }
  [[nodiscard]] bool bare_free(const Configuration& q) const { return bare_.state_free(q); }
  [[nodiscard]] bool exact_free(const Configuration& q) const {
    return !exact_.check(q, world_.frame.trolley, &world_.perception.map()).any();
  }
  [[nodiscard]] bool exact_edge_free(const Configuration& a, const Configuration& b) const {
    const int steps = 1 + static_cast<int>((b - a).lpNorm<1>() / kJudgeStep);
    for (int i = 0; i <= steps; ++i) {
      if (!exact_free(a + static_cast<double>(i) / steps * (b - a))) return false;
    }
    return true;
  }
  /// Around the states of views: at random over all joint ranges few states come near the plants.
  Configuration random_configuration() {
    if (views_.empty()) views_ = world_.draw_views(400, 11);
    const JointLimits& limits = world_.robot.limits();
    Configuration q(world_.robot.dof());
    if (rng_.chance(0.5)) {
      q = views_[rng_.index(views_.size())].q;
      for (double& joint : q) joint += rng_.uniform(-0.5, 0.5);
      return q.cwiseMax(limits.lower).cwiseMin(limits.upper);
    }
    for (int i = 0; i < q.size(); ++i) q[i] = rng_.uniform(limits.lower[i], limits.upper[i]);
    return q;
  }

  const Glasshouse& world_;
  CollisionChecker bare_;
  ExactChecker exact_;
  Rng rng_;
  std::vector<ViewPose> views_;
  int cases_ = 0;
  int near_ = 0;
  int accepted_ = 0;
  int edges_ = 0;
  int violations_ = 0;
};

}  // namespace
}  // namespace canopeer

int main(int argc, char** argv) {
  const int cases = argc > 1 ? std::atoi(argv[1]) : 100000;
  const canopeer::Glasshouse world(
      argc > 2 ? argv[2] : CANOPEER_SOURCE_DIR "/robots/ur5e_trolley/robot.yaml");
  canopeer::Judge judge(world);
  for (int i = 0; i < cases; ++i) {
    if (i % 2 == 0) {
      judge.state_near_contact();
    } else if (i % 10 == 1) {
      judge.random_edge();
    } else {
      judge.random_state();
    }
  }
  judge.report_cases();
  judge.report_false_alarms(400);
  return judge.violations() == 0 ? 0 : 1;
}
