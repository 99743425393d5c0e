#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/robot/configuration.h"
#include "canopeer/robot/joint_limits.h"

namespace canopeer {

/// The views of a whole mission, known beforehand: by segment, in order, the configurations that
/// the arm stands in. The view at home, which every segment begins with, is not among them.
struct ViewPlan {
  std::vector<std::vector<Configuration>> segments;
};

/// What a plan has to fit: so many segments, and an arm.
struct PlanFit {
  int segments = 0;
  JointLimits limits;
};

/// JSON (docs/formats.md). Each number is the shortest that reads back as the same, so the same
/// plan gives the same bytes. The error names what is not finite.
[[nodiscard]] Expected<std::string> view_plan_json(const ViewPlan& plan);
[[nodiscard]] Expected<void> write_view_plan(const std::filesystem::path& path,
                                             const ViewPlan& plan);

/// The error names the file and the line and column, or the segment, view and joint. All
/// configurations have the same number of joints.
[[nodiscard]] Expected<ViewPlan> read_view_plan(const std::filesystem::path& path);
/// The same from text; errors begin with `name`.
[[nodiscard]] Expected<ViewPlan> parse_view_plan(std::string_view text, std::string_view name);

/// As many segments as the mission, the arm's joints, within their limits. The error says which
/// segment, view and joint is not.
[[nodiscard]] Expected<void> check_plan(const ViewPlan& plan, const PlanFit& fit);

}  // namespace canopeer
