#pragma once

#include <exception>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "canopeer/record/run_record.h"

/// Events as JSON. Private to this module.
/// The readers throw the library's exceptions when a key is missing or of the wrong type.
namespace canopeer::event_json {

using Json = nlohmann::ordered_json;

/// Of the lines this version writes and the only one it reads.
inline constexpr int kFormatVersion = 1;

Json from(const RunHeader& header);
Json from(const SegmentEvent& segment);
Json from(const ViewEvent& view);
/// Its fruits as what is new beside `before`, those of the event before.
Json from(const FrameEvent& frame, const std::vector<FruitSnapshot>& before);
Json from(const MotionEvent& motion);
Json from(const SteeringEvent& steering);
Json from(const FaultEvent& fault);
Json from(const std::vector<WorkItem>& work);
Json from(const TimeSplit& time);

RunHeader to_header(const Json& json);
SegmentEvent to_segment(const Json& json);
ViewEvent to_view(const Json& json);
FrameEvent to_frame(const Json& json, const std::vector<FruitSnapshot>& before);
MotionEvent to_motion(const Json& json);
SteeringEvent to_steering(const Json& json);
FaultEvent to_fault(const Json& json);
std::vector<WorkItem> to_work(const Json& json);
TimeSplit to_time(const Json& json);

/// null stands for a number that was not finite.
double to_number(const Json& json);

/// What the library's exception says, without its own numbering in front.
std::string reason(const std::exception& exception);

}  // namespace canopeer::event_json
