// The price of a conservative check, over a whole mission: of all the motions that the planner
// proposes as edges of its graph, how many does the fast check reject though FCL calls them free in
// the map of that moment? And does it ever accept one that touches?
//   edge_alarms [mission.yaml] [seconds per segment, default 10] [accepted edges judged: one in so
//   many, default 10]

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>

#include "canopeer/robot/exact_checker.h"
#include "canopeer/run/run.h"
#include "support/must.h"

namespace canopeer {
namespace {

constexpr double kJudgeStep = 0.02;  // Σ|Δq| between the states of an edge that are judged

struct Counts {
  long proposed = 0;
  long rejected = 0;
  long false_alarms = 0;
  long accepted_judged = 0;
  long accepted_touching = 0;

  void print(const char* name) const {
    // Accepted edges are free, so the free ones are those and the false alarms.
    const long accepted = proposed - rejected;
    std::printf(
        "%-16s proposed %8ld  rejected %7ld  of these free by FCL %6ld: %.2f %% of the proposed, "
        "%.2f %% of the free; accepted and judged %ld, touching %ld\n",
        name, proposed, rejected, false_alarms,
        100.0 * static_cast<double>(false_alarms) / static_cast<double>(std::max(1L, proposed)),
        100.0 * static_cast<double>(false_alarms) /
            static_cast<double>(std::max(1L, accepted + false_alarms)),
        accepted_judged, accepted_touching);
  }
};

class Audit {
 public:
  Audit(Stage& stage, const VoxelMap& map, int one_in)
      : exact_(stage.robot().model),
        trolley_(*stage.site().ports().trolley),
        one_in_(one_in),
        map_(map) {}

  void edge(const Configuration& a, const Configuration& b, bool free) {
    const TrolleyState at = trolley_.state();
    char stop[32];
    std::snprintf(stop, sizeof stop, "stop at %.1f m", at.travel_m);
    for (Counts* counts : {&all_, &by_stop_[stop]}) {
      ++counts->proposed;
      counts->rejected += free ? 0 : 1;
    }
    if (!free) {
      if (!exact_free(a, b, at)) return;
      ++all_.false_alarms;
      ++by_stop_[stop].false_alarms;
    } else if (all_.proposed % one_in_ == 0) {
      ++all_.accepted_judged;
      all_.accepted_touching += exact_free(a, b, at) ? 0 : 1;
    }
  }

  void print() const {
    for (const auto& [stop, counts] : by_stop_) counts.print(stop.c_str());
    all_.print("all");
  }
  [[nodiscard]] bool trustworthy() const { return all_.accepted_touching == 0; }

 private:
  [[nodiscard]] bool exact_free(const Configuration& a, const Configuration& b,
                                const TrolleyState& at) const {
    const int steps = 1 + static_cast<int>((b - a).lpNorm<1>() / kJudgeStep);
    for (int i = 0; i <= steps; ++i) {
      if (exact_.check(a + static_cast<double>(i) / steps * (b - a), at, &map_).any()) return false;
    }
    return true;
  }

  ExactChecker exact_;
  const Trolley& trolley_;
  int one_in_;
  const VoxelMap& map_;
  Counts all_;
  std::map<std::string, Counts> by_stop_;
};

}  // namespace
}  // namespace canopeer

int main(int argc, char** argv) {
  using namespace canopeer;
  StageRequest request;
  request.mission = argc > 1 ? argv[1] : CANOPEER_SOURCE_DIR "/missions/scenario_1.yaml";
  request.overrides = {{"time_per_segment_s", argc > 2 ? argv[2] : "10"}};
  request.table_dirs = {CANOPEER_SOURCE_DIR "/compute_tables"};
  MissionFile file = must(load_mission(request.mission, request.overrides, request.table_dirs));
  std::optional<Audit> audit;
  file.mission.planners.vmp.builder.on_edge = [&](const Configuration& a, const Configuration& b,
                                                  bool free) { audit->edge(a, b, free); };
  const RunRegistries registries = RunRegistries::built_in();
  const auto out = std::filesystem::temp_directory_path() / "canopeer_edge_alarms";
  const auto run = must(Run::compose(std::move(file), request, registries, out));
  audit.emplace(run->stage(), run->mission().map(),
                argc > 3 ? std::max(1, std::atoi(argv[3])) : 10);
  must(run->begin());
  while (run->step()) {
    const MissionCursor& at = run->mission().cursor();
    std::fprintf(stderr, "\rsegment %d, %d views ", at.segment + 1, at.views);
  }
  std::fprintf(stderr, "\n");
  std::filesystem::remove_all(out);
  must(Expected<void>(run->outcome()));
  audit->print();
  return audit->trustworthy() ? 0 : 1;
}
