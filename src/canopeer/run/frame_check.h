#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "canopeer/mission/listeners.h"
#include "canopeer/sensing/frame_agreement.h"

namespace canopeer {

/// Keeps a few of a run's frames, at rest and on the way, to say in the end whether their poses fit
/// what they show. It only looks on.
class FrameCheck : public Keeper {
 public:
  [[nodiscard]] Expected<void> on_event(const Event& event) override;

  /// From what was kept until now; nothing: no frame was taken on the way.
  [[nodiscard]] std::optional<FrameAgreement> judge() const;

  /// What was kept, as bytes, and from them. The error: they are none of these.
  [[nodiscard]] std::string save() const;
  [[nodiscard]] Expected<void> restore(std::string_view state);

 private:
  FrameSample sample_;
};

}  // namespace canopeer
