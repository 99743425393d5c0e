// Watches a mission while it works, and ends it when it has found enough.
//   05_watcher missions/smoke.yaml out/watched

#include <cstdio>

#include "canopeer/mission/steering_desk.h"
#include "canopeer/run/run.h"

using namespace canopeer;

namespace {

/// Prints what happens. In a thread of its own: however long it takes, the mission does not wait.
class Printer : public Watcher {
 public:
  EventNeeds needs() const override { return {.map = false, .plan = true}; }

  void on_event(const Event& event) override {
    if (const auto* e = std::get_if<SegmentBegun>(&event)) {
      std::printf("%s\n", e->segment.name.c_str());
    } else if (const auto* p = std::get_if<Planned>(&event)) {
      std::printf("%7.2f s  %4zu views in the graph, %zu on the path\n", p->t_s,
                  p->sketch->views.size(), p->sketch->path.size() + 1);
    } else if (const auto* f = std::get_if<FrameTaken>(&event)) {
      std::printf("%7.2f s  view %d: hoped for %.0f new voxels, got %lld; %zu fruits\n",
                  f->view.t_s, f->view.view, f->view.predicted_gain.value_or(0.0),
                  static_cast<long long>(f->view.realised_gain), f->view.fruits.size());
    } else if (const auto* s = std::get_if<Steered>(&event)) {
      std::printf("%7.2f s  told to %s by '%s'\n", s->t_s,
                  std::string(steering_name(s->word.kind)).c_str(), s->word.by.c_str());
    } else if (const auto* end = std::get_if<RunEnded>(&event)) {
      std::printf("%7.2f s  the end\n", end->end_s);
    }
  }
};

int complain(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return complain({"usage: 05_watcher MISSION OUT"});
  StageRequest request;
  request.mission = argv[1];
  request.table_dirs = {request.mission.parent_path() / "../compute_tables"};
  SteeringPolicy enough("twelve fruits are enough", [](const SteeringPoint& at) {
    return at.fruits >= 12 ? SteeringWord::Kind::stop : SteeringWord::Kind::go_on;
  });
  const auto run = Run::compose(request, RunRegistries::built_in(), argv[2]);
  if (!run) return complain(run.error());
  (*run)->watch(std::make_shared<Printer>(), {.name = "printer"});
  (*run)->steer(enough);

  const auto summary = (*run)->execute();
  return summary ? 0 : complain(summary.error());
}
