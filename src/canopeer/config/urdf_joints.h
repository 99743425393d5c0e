#pragma once

#include <string>

#include "canopeer/base/expected.h"
#include "canopeer/robot/robot_description.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace canopeer {

/// The document as text for a parser that stumbles over what read_motion() reads: joints without
/// <mimic>, <safety_controller>, <calibration> and <dynamics>, with a <limit> that says nothing.
[[nodiscard]] std::string without_motions(const tinyxml2::XMLDocument& document);

/// Reads <limit>, <mimic> and the soft limits of <safety_controller> into `joint`, whose type is
/// set. Limits beside a continuous joint count when there are both and they differ; without, it
/// turns without end. Attributes that a joint needs only if something moves it become its `flaw`.
/// The effort is not asked for. Errors: no <limit> where the type needs one, no number where one
/// must be, a <mimic> that names no joint.
[[nodiscard]] Expected<void> read_motion(const tinyxml2::XMLElement& element, Joint& joint);

}  // namespace canopeer
