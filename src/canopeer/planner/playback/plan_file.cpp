#include "canopeer/planner/playback/plan_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "canopeer/base/atomic_file.h"
#include "canopeer/base/exact_text.h"

namespace canopeer {
namespace {

using PlanJson = nlohmann::json;

constexpr const char* kVersionKey = "canopeer_plan";
constexpr int kPlanVersion = 1;

/// "segment 3, view 2, joint 1": people count from one.
std::string place_in_plan(std::size_t segment) { return "segment " + std::to_string(segment + 1); }
std::string place_in_plan(std::size_t segment, std::size_t view) {
  return place_in_plan(segment) + ", view " + std::to_string(view + 1);
}
std::string place_in_plan(std::size_t segment, std::size_t view, std::size_t joint) {
  return place_in_plan(segment, view) + ", joint " + std::to_string(joint + 1);
}

Expected<Configuration> configuration_of(const PlanJson& json, std::size_t segment,
                                         std::size_t view) {
  if (!json.is_array() || json.empty()) {
    return fail(place_in_plan(segment, view) + ": expected a list of joint positions");
  }
  if (json.size() > static_cast<std::size_t>(kMaxArmJoints)) {
    return fail(place_in_plan(segment, view) + ": " + std::to_string(json.size()) +
                " joint positions; an arm has at most " + std::to_string(kMaxArmJoints));
  }
  Configuration q(static_cast<Eigen::Index>(json.size()));
  for (std::size_t joint = 0; joint < json.size(); ++joint) {
    if (!json[joint].is_number()) {
      return fail(place_in_plan(segment, view, joint) + ": expected a number");
    }
    q[static_cast<Eigen::Index>(joint)] = json[joint].get<double>();
  }
  return q;
}

/// All as long as the first there is.
Expected<void> check_lengths(const ViewPlan& plan) {
  Eigen::Index joints = 0;
  for (std::size_t s = 0; s < plan.segments.size(); ++s) {
    for (std::size_t v = 0; v < plan.segments[s].size(); ++v) {
      const Eigen::Index size = plan.segments[s][v].size();
      if (joints == 0) joints = size;
      if (size == joints) continue;
      return fail(place_in_plan(s, v) + ": " + std::to_string(size) +
                  " joint positions; those before have " + std::to_string(joints));
    }
  }
  return {};
}

Expected<ViewPlan> plan_of(const PlanJson& json) {
  if (!json.is_object() || !json.contains(kVersionKey)) {
    return fail(std::string("expected an object with the key \"") + kVersionKey + "\"");
  }
  if (json[kVersionKey] != kPlanVersion) {
    return fail(std::string("\"") + kVersionKey + "\": expected " + std::to_string(kPlanVersion) +
                ", the version this program reads");
  }
  for (const auto& [key, value] : json.items()) {
    if (key != kVersionKey && key != "segments") {
      return fail("unknown key \"" + key + "\"; a plan has \"" + kVersionKey +
                  "\" and \"segments\"");
    }
  }
  if (!json.contains("segments") || !json["segments"].is_array()) {
    return fail("\"segments\": expected a list with the views of each segment");
  }
  ViewPlan plan;
  for (const PlanJson& segment : json["segments"]) {
    const std::size_t s = plan.segments.size();
    if (!segment.is_array()) return fail(place_in_plan(s) + ": expected a list of views");
    auto& views = plan.segments.emplace_back();
    for (const PlanJson& view : segment) {
      auto q = configuration_of(view, s, views.size());
      if (!q) return tl::unexpected(q.error());
      views.push_back(std::move(*q));
    }
  }
  if (auto ok = check_lengths(plan); !ok) return tl::unexpected(ok.error());
  return plan;
}

/// "line 3, column 7" of a byte of the text.
std::string line_and_column(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t begin = before.rfind('\n') + 1;  // 0 in the first line
  return "line " + std::to_string(line) + ", column " +
         std::to_string(std::max<std::size_t>(1, before.size() - begin));
}

}  // namespace

Expected<std::string> view_plan_json(const ViewPlan& plan) {
  std::string text = std::string("{\n  \"") + kVersionKey + "\": " + std::to_string(kPlanVersion) +
                     ",\n  \"segments\": [";
  for (std::size_t s = 0; s < plan.segments.size(); ++s) {
    text += s == 0 ? "\n    [" : ",\n    [";
    for (std::size_t v = 0; v < plan.segments[s].size(); ++v) {
      const Configuration& q = plan.segments[s][v];
      text += v == 0 ? "\n      [" : ",\n      [";
      for (Eigen::Index joint = 0; joint < q.size(); ++joint) {
        if (!std::isfinite(q[joint])) {
          return fail(place_in_plan(s, v, static_cast<std::size_t>(joint)) + ": not a number");
        }
        text +=
            (joint == 0 ? "" : ", ") + exact_text(q[joint] + 0.0);  // JSON readers take −0 for 0
      }
      text += "]";
    }
    text += plan.segments[s].empty() ? "]" : "\n    ]";
  }
  return text + (plan.segments.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

Expected<void> write_view_plan(const std::filesystem::path& path, const ViewPlan& plan) {
  const auto text = view_plan_json(plan);
  if (!text) return fail_in(path.string(), text.error());
  return write_file(path, *text);
}

Expected<ViewPlan> read_view_plan(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_view_plan(*text, path.string());
}

Expected<ViewPlan> parse_view_plan(std::string_view text, std::string_view name) {
  const std::string file(name);
  try {
    auto plan = plan_of(PlanJson::parse(text));
    if (!plan) return fail_in(file, plan.error());
    return plan;
  } catch (const PlanJson::parse_error& error) {
    return fail(file + ": " + line_and_column(text, error.byte) + ": this is no JSON");
  } catch (const PlanJson::exception&) {
    return fail(file + ": a number is too large for any joint");
  }
}

Expected<void> check_plan(const ViewPlan& plan, const PlanFit& fit) {
  const auto segments = static_cast<std::size_t>(fit.segments);
  if (plan.segments.size() != segments) {
    return fail("it has " + std::to_string(plan.segments.size()) +
                " segments, and the mission has " + std::to_string(segments));
  }
  const Eigen::Index joints = fit.limits.lower.size();
  for (std::size_t s = 0; s < segments; ++s) {
    for (std::size_t v = 0; v < plan.segments[s].size(); ++v) {
      const Configuration& q = plan.segments[s][v];
      if (q.size() != joints) {
        return fail(place_in_plan(s, v) + ": " + std::to_string(q.size()) +
                    " joint positions, and the robot has " + std::to_string(joints) + " joints");
      }
      for (Eigen::Index j = 0; j < joints; ++j) {
        const double lower = fit.limits.lower[j];
        const double upper = fit.limits.upper[j];
        if (q[j] >= lower - kLimitTolerance && q[j] <= upper + kLimitTolerance) continue;
        return fail(place_in_plan(s, v, static_cast<std::size_t>(j)) + ": " + exact_text(q[j]) +
                    " is beyond the robot's limits, " + exact_text(lower) + " ... " +
                    exact_text(upper));
      }
    }
  }
  return {};
}

}  // namespace canopeer
