#include "canopeer/mission/segment/timekeeper.h"

#include <string>
#include <utility>

namespace canopeer {

Timekeeper::Timekeeper(Clock& clock, const CostTable& costs, Planner& planner,
                       int background_workers, StageTimer& timer)
    : clock_(clock),
      costs_(costs),
      timer_(timer),
      background_(planner, clock, background_workers, meters_.background) {
  meters_.booked_s = clock.now_s();
}

void Timekeeper::book(double TimeSplit::*kind) {
  const double now_s = clock_.now_s();
  meters_.time.*kind += now_s - meters_.booked_s;
  meters_.booked_s = now_s;
}

void Timekeeper::pay(const WorkMeter& work) {
  meters_.foreground.merge(work);
  const double seconds = work.seconds(costs_);
  clock_.charge(seconds);
  goes_on(seconds);
}

void Timekeeper::pass(double seconds) {
  clock_.sleep(seconds);
  goes_on(seconds);
}

void Timekeeper::aside(const WorkMeter& work) {
  background_.beside([&](Planner&) { meters_.background.merge(work); });
}

void Timekeeper::goes_on(double seconds) {
  timer_.time("planner: graph", [&] { background_.time_passes(seconds); });
}

std::vector<WorkItem> Timekeeper::work_items() const {
  std::vector<WorkItem> items;
  for (const auto& [meter, where] :
       {std::pair{&meters_.foreground, ""}, std::pair{&meters_.background, " (background)"}}) {
    for (std::size_t i = 0; i < kWorkKinds; ++i) {
      const auto kind = static_cast<Work>(i);
      const std::int64_t units = meter->units(kind);
      if (units == 0) continue;
      items.push_back(
          {std::string(work_name(kind)) + where, units, static_cast<double>(units) * costs_[kind]});
    }
  }
  return items;
}

}  // namespace canopeer
