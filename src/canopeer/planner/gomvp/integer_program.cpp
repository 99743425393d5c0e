#include "canopeer/planner/gomvp/integer_program.h"

#include <algorithm>
#include <set>
#include <utility>

namespace canopeer {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

InspectionProgram::InspectionProgram(const InspectionProblem& problem, int neighbors,
                                     const InspectionPath& known)
    : problem_(problem) {
  choose_arcs(neighbors, known);
  add_columns();
  add_path_rows();
  add_flow_rows();
  add_target_rows();
}

void InspectionProgram::choose_arcs(int neighbors, const InspectionPath& known) {
  std::set<std::pair<int, int>> taken;
  for (std::size_t i = 1; i < known.size(); ++i) taken.emplace(known[i - 1], known[i]);
  for (int from = 0; from < problem_.views(); ++from) {
    const auto& times_s = problem_.between_s[static_cast<std::size_t>(from)];
    std::vector<std::pair<double, int>> nearest;
    for (int to = 0; to < problem_.views(); ++to) {
      if (to != from) nearest.emplace_back(times_s[static_cast<std::size_t>(to)], to);
    }
    const auto count = std::min(nearest.size(), static_cast<std::size_t>(neighbors));
    std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count),
                      nearest.end());
    for (std::size_t k = 0; k < count; ++k) taken.emplace(from, nearest[k].second);
  }
  for (int to = 0; to < problem_.views(); ++to)
    arcs_.push_back({kStart, to, problem_.from_start_s[static_cast<std::size_t>(to)]});
  for (const auto& [from, to] : taken)
    arcs_.push_back(
        {from, to,
         problem_.between_s[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)]});
}

int InspectionProgram::add_column(double cost, double upper, bool integer) {
  const int column = program_.column_count();
  program_.cost.push_back(cost);
  program_.lower.push_back(0.0);
  program_.upper.push_back(upper);
  if (integer) program_.integers.push_back(column);
  return column;
}

void InspectionProgram::add_row(const Row& row, double lower, double upper) {
  program_.columns.insert(program_.columns.end(), row.columns.begin(), row.columns.end());
  program_.values.insert(program_.values.end(), row.values.begin(), row.values.end());
  program_.starts.push_back(static_cast<int>(program_.columns.size()));
  program_.row_lower.push_back(lower);
  program_.row_upper.push_back(upper);
}

double InspectionProgram::most_views() const {
  return std::min(problem_.views(), problem_.targets());
}

void InspectionProgram::add_columns() {
  const bool cover = problem_.objective == InspectionProblem::Objective::cover;
  const double price = cover ? 1.0 : problem_.price_of_time();
  for (int view = 0; view < problem_.views(); ++view) add_column(0.0, 1.0, true);
  for (const Arc& arc : arcs_) add_column(price * arc.time_s, 1.0, true);
  for (std::size_t a = 0; a < arcs_.size(); ++a) add_column(0.0, most_views(), false);
  if (cover) return;
  for (const double weight : problem_.weight) add_column(-weight, 1.0, false);
}

void InspectionProgram::add_path_rows() {
  const auto views = static_cast<std::size_t>(problem_.views());
  std::vector<Row> in(views);
  std::vector<Row> out(views);
  Row start;
  Row time;
  for (std::size_t a = 0; a < arcs_.size(); ++a) {
    const Arc& arc = arcs_[a];
    in[static_cast<std::size_t>(arc.to)].put(x(a), 1.0);
    (arc.from == kStart ? start : out[static_cast<std::size_t>(arc.from)]).put(x(a), 1.0);
    time.put(x(a), arc.time_s);
  }
  for (std::size_t i = 0; i < views; ++i) {
    in[i].put(y(static_cast<int>(i)), -1.0);
    add_row(in[i], 0.0, 0.0);
    out[i].put(y(static_cast<int>(i)), -1.0);
    add_row(out[i], -kInfinite, 0.0);
  }
  add_row(start, -kInfinite, 1.0);
  const bool timed = problem_.objective == InspectionProblem::Objective::orienteering;
  if (timed && problem_.budget_s < kInfinite) add_row(time, -kInfinite, problem_.budget_s);
}

void InspectionProgram::add_flow_rows() {
  std::vector<Row> balance(static_cast<std::size_t>(problem_.views()));
  for (std::size_t a = 0; a < arcs_.size(); ++a) {
    const Arc& arc = arcs_[a];
    Row most;
    most.put(f(a), 1.0);
    most.put(x(a), -most_views());
    add_row(most, -kInfinite, 0.0);
    Row least;
    least.put(f(a), 1.0);
    least.put(x(a), -1.0);
    add_row(least, 0.0, kInfinite);
    balance[static_cast<std::size_t>(arc.to)].put(f(a), 1.0);
    if (arc.from != kStart) balance[static_cast<std::size_t>(arc.from)].put(f(a), -1.0);
  }
  for (std::size_t i = 0; i < balance.size(); ++i) {
    balance[i].put(y(static_cast<int>(i)), -1.0);
    add_row(balance[i], 0.0, 0.0);
  }
}

void InspectionProgram::add_target_rows() {
  const bool cover = problem_.objective == InspectionProblem::Objective::cover;
  for (int target = 0; target < problem_.targets(); ++target) {
    Row seen;
    for (const int view : problem_.seen_by[static_cast<std::size_t>(target)])
      seen.put(y(view), 1.0);
    if (!cover) seen.put(z(target), -1.0);
    add_row(seen, cover ? 1.0 : 0.0, kInfinite);
  }
}

std::vector<double> InspectionProgram::values_of(const InspectionPath& path) const {
  std::vector<double> values(static_cast<std::size_t>(program_.column_count()), 0.0);
  for (std::size_t i = 0; i < path.size(); ++i) {
    values[static_cast<std::size_t>(y(path[i]))] = 1.0;
    const int from = i == 0 ? kStart : path[i - 1];
    for (std::size_t a = 0; a < arcs_.size(); ++a) {
      if (arcs_[a].from != from || arcs_[a].to != path[i]) continue;
      values[static_cast<std::size_t>(x(a))] = 1.0;
      values[static_cast<std::size_t>(f(a))] = static_cast<double>(path.size() - i);
    }
  }
  if (problem_.objective == InspectionProblem::Objective::cover) return values;
  for (int target = 0; target < problem_.targets(); ++target) {
    const auto& views = problem_.seen_by[static_cast<std::size_t>(target)];
    const bool seen = std::any_of(path.begin(), path.end(), [&](int view) {
      return std::binary_search(views.begin(), views.end(), view);
    });
    values[static_cast<std::size_t>(z(target))] = seen ? 1.0 : 0.0;
  }
  return values;
}

InspectionPath InspectionProgram::path_of(const std::vector<double>& values) const {
  InspectionPath path;
  int at = kStart;
  while (static_cast<int>(path.size()) < problem_.views()) {
    const auto taken = std::find_if(arcs_.begin(), arcs_.end(), [&](const Arc& arc) {
      const auto a = static_cast<std::size_t>(&arc - arcs_.data());
      return arc.from == at && values[static_cast<std::size_t>(x(a))] > 0.5;
    });
    if (taken == arcs_.end()) break;
    at = taken->to;
    path.push_back(at);
  }
  return path;
}

}  // namespace canopeer
