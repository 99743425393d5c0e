#pragma once

#include "canopeer/base/expected.h"
#include "canopeer/robot/robot_description.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace canopeer {

/// Takes out of the joints what read_motion() reads, for a parser that stumbles over it: `<mimic>`,
/// `<safety_controller>`, `<calibration>` and `<dynamics>`; a `<limit>` that says nothing stays.
void strip_motions(tinyxml2::XMLDocument& document);

/// Reads `<limit>`, `<mimic>` and the soft limits of `<safety_controller>` into `joint`, whose type
/// is set. Limits beside a continuous joint count when there are both and they differ; without, it
/// turns without end. Attributes that a joint needs only if something moves it become its `flaw`.
/// The effort is not asked for. Errors: no `<limit>` where the type needs one, no number where one
/// must be, a `<mimic>` that names no joint.
[[nodiscard]] Expected<void> read_motion(const tinyxml2::XMLElement& element, Joint& joint);

}  // namespace canopeer
