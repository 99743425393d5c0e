#include "canopeer/mission/ports.h"

namespace canopeer {

std::string_view motion_end_name(MotionEnd end) {
  switch (end) {
    case MotionEnd::arrived:
      return "arrived";
    case MotionEnd::refused:
      return "refused";
    case MotionEnd::aborted:
      return "aborted";
    case MotionEnd::cancelled:
      return "cancelled";
    case MotionEnd::preempted:
      return "preempted";
    case MotionEnd::stopped:
      return "stopped";
    case MotionEnd::withheld:
      return "withheld";
  }
  return "arrived";
}

}  // namespace canopeer
