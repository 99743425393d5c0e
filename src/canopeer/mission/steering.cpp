#include "canopeer/mission/steering.h"

namespace canopeer {

std::string_view steering_name(SteeringWord::Kind kind) {
  switch (kind) {
    case SteeringWord::Kind::go_on:
      return "go_on";
    case SteeringWord::Kind::pause:
      return "pause";
    case SteeringWord::Kind::wait_for_person:
      return "wait_for_person";
    case SteeringWord::Kind::next_segment:
      return "next_segment";
    case SteeringWord::Kind::stop:
      return "stop";
  }
  return "go_on";
}

}  // namespace canopeer
