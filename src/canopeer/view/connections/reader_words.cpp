#include "canopeer/view/connections/reader_words.h"

#include <nlohmann/json.hpp>

namespace canopeer {

std::string greeting_frame(bool live, bool may_steer, std::size_t frames) {
  const nlohmann::ordered_json head = {{"type", "reader"},
                                       {"live", live},
                                       {"controls", may_steer},
                                       {"frames", frames},
                                       {"bytes", 0}};
  return head.dump() + "\n";
}

std::string pace_frame(double speed) {
  const nlohmann::ordered_json head = {{"type", "pace"}, {"factor", speed}, {"bytes", 0}};
  return head.dump() + "\n";
}

std::string lost_frame(std::int64_t frames) {
  return "{\"type\":\"lost\",\"frames\":" + std::to_string(frames) + ",\"bytes\":0}\n";
}

std::optional<ReaderWord> reader_word(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const nlohmann::json type = json.value("type", nlohmann::json());
  const nlohmann::json word = json.value("word", nlohmann::json());
  if (type == "steer" && word.is_string()) {
    using Kind = SteeringWord::Kind;
    for (const Kind kind : {Kind::go_on, Kind::next_segment, Kind::pause, Kind::stop}) {
      if (word.get<std::string>() == steering_name(kind)) return kind;
    }
  }
  const nlohmann::json factor = json.value("factor", nlohmann::json());
  if (type == "speed" && factor.is_number()) {
    const double speed = factor.get<double>();
    if (speed >= 0.0 && speed <= 1e6) return speed;
  }
  return std::nullopt;
}

}  // namespace canopeer
