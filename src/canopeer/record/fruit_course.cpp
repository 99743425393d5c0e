#include "canopeer/record/fruit_course.h"

namespace canopeer {

std::vector<FruitsAtTime> fruit_course(const RunRecord& record) {
  std::vector<FruitsAtTime> course;
  course.reserve(record.views.size() + record.frames.size());
  auto frame = record.frames.begin();
  const auto add_frame = [&] { course.push_back({frame->t_s, &frame->fruits, true}); };
  for (const ViewEvent& view : record.views) {
    for (; frame != record.frames.end() && frame->view <= view.view; ++frame) add_frame();
    course.push_back({view.t_s, &view.fruits, false});
  }
  for (; frame != record.frames.end(); ++frame) add_frame();
  return course;
}

std::map<int, FruitsAtTime> first_known(const std::vector<FruitsAtTime>& course) {
  std::map<int, FruitsAtTime> first;
  for (const FruitsAtTime& at : course) {
    for (const FruitSnapshot& fruit : *at.fruits) first.try_emplace(fruit.id, at);
  }
  return first;
}

}  // namespace canopeer
