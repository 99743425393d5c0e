#include "canopeer/run/frame_check.h"

#include <variant>

#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

/// Hands each event on to what it is for the sample.
struct SampleVisitor {
  FrameSample& sample;
  void operator()(const FrameTaken& e) const { sample.add_still(*e.frame); }
  void operator()(const FrameOnTheWay& e) const { sample.add_moving(*e.images, e.twist); }
  void operator()(const MotionBegun& e) const { sample.moves_from(e.start_s); }
  void operator()(const MotionEnded& e) const {
    sample.rests_from(e.motion.start_s + e.motion.duration_s);
  }
  template <typename Other>
  void operator()(const Other&) const {}
};

}  // namespace

Expected<void> FrameCheck::on_event(const Event& event) {
  std::visit(SampleVisitor{sample_}, event);
  return {};
}

std::optional<FrameAgreement> FrameCheck::judge() const {
  if (sample_.moving() == 0) return std::nullopt;
  return judge_agreement(sample_);
}

std::string FrameCheck::save() const { return state_bytes(sample_); }

Expected<void> FrameCheck::restore(std::string_view state) {
  return read_state_bytes(state, sample_);
}

}  // namespace canopeer
