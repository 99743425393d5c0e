#include "canopeer/config/urdf_joints.h"

#include <tinyxml2.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

namespace canopeer {
namespace {

using tinyxml2::XMLElement;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The number of an attribute; nothing where there is none.
Expected<std::optional<double>> number(const XMLElement& element, const char* name) {
  const char* const text = element.Attribute(name);
  if (text == nullptr) return std::optional<double>();
  std::string_view digits(text);
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!digits.empty() && blank(digits.front())) digits.remove_prefix(1);
  while (!digits.empty() && blank(digits.back())) digits.remove_suffix(1);
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code == std::errc::result_out_of_range) {
    value = digits.front() == '-' ? -kInfinity : kInfinity;  // 1e999; 1e-999 is as good as none
  } else if (code != std::errc() || end != digits.data() + digits.size() || std::isnan(value)) {
    return fail(std::string("<") + element.Name() + " " + name + "=\"" + text +
                "\">: expected a number");
  }
  return std::optional<double>(value);
}

Expected<void> read_limit(const XMLElement& element, bool continuous, Joint& joint) {
  const auto lower = number(element, "lower");
  const auto upper = number(element, "upper");
  const auto velocity = number(element, "velocity");
  for (const auto* read : {&lower, &upper, &velocity}) {
    if (!*read) return fail(read->error().message);
  }
  joint.velocity_limit = velocity->value_or(0.0);
  const bool both = lower->has_value() && upper->has_value();
  const bool one = lower->has_value() || upper->has_value();
  if (one && !both)
    joint.flaw = std::string("its <limit> has ") +
                 (*lower ? "a lower limit but no upper" : "an upper limit but no lower");
  if (continuous) {
    // Exporters write 0 and 0 where there is no limit.
    if (!both || **lower == **upper) return {};
  } else if (!one) {
    joint.flaw = "its <limit> has neither lower nor upper";
  }
  joint.lower = lower->value_or(0.0);  // as URDF has it
  joint.upper = upper->value_or(0.0);
  return {};
}

Expected<void> read_mimic(const XMLElement& element, Joint& joint) {
  const char* const master = element.Attribute("joint");
  if (master == nullptr || *master == '\0')
    return fail("its <mimic> names no joint: <mimic joint=\"...\"/>");
  const auto multiplier = number(element, "multiplier");
  const auto offset = number(element, "offset");
  for (const auto* read : {&multiplier, &offset}) {
    if (!*read) return fail(read->error().message);
    if (std::isinf(read->value().value_or(0.0)))
      return fail("<mimic>: expected a finite multiplier and offset");
  }
  joint.mimics = master;
  joint.multiplier = multiplier->value_or(1.0);
  joint.offset = offset->value_or(0.0);
  return {};
}

}  // namespace

void strip_motions(tinyxml2::XMLDocument& document) {
  for (auto* joint = document.RootElement()->FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    for (const char* tag : {"limit", "mimic", "safety_controller", "calibration", "dynamics"}) {
      while (auto* child = joint->FirstChildElement(tag)) joint->DeleteChild(child);
    }
    auto* limit = document.NewElement("limit");
    for (const char* name : {"lower", "upper", "effort", "velocity"})
      limit->SetAttribute(name, "0");
    joint->InsertEndChild(limit);
  }
}

Expected<void> read_motion(const XMLElement& element, Joint& joint) {
  if (const auto* mimic = element.FirstChildElement("mimic")) {
    if (auto read = read_mimic(*mimic, joint); !read) return read;
  }
  if (joint.type != JointType::kRevolute && joint.type != JointType::kPrismatic) return {};
  const char* const type = element.Attribute("type");
  const bool continuous = type != nullptr && std::string_view(type) == "continuous";
  const auto* limit = element.FirstChildElement("limit");
  if (limit != nullptr) {
    if (auto read = read_limit(*limit, continuous, joint); !read) return read;
  } else if (!continuous) {
    return fail(std::string(type) +
                " joints need <limit lower=\"...\" upper=\"...\" "
                "velocity=\"...\"/>");
  } else {
    joint.velocity_limit = 0.0;
  }
  if (const auto* safety = element.FirstChildElement("safety_controller")) {
    const auto lower = number(*safety, "soft_lower_limit");
    const auto upper = number(*safety, "soft_upper_limit");
    if (lower && upper && *lower && *upper && **lower < **upper) {
      joint.soft_lower = **lower;
      joint.soft_upper = **upper;
    }
  }
  return {};
}

}  // namespace canopeer
