#include "canopeer/bounds/limits/coverage_program.h"

#include <algorithm>

namespace canopeer {
namespace {

/// Rows that a segment's variables stand in; −1: there is no such row.
struct SegmentRows {
  int chain = -1;   // it ends before the next begins, or by t
  int lasts = -1;   // it ends no sooner than its time is up
  int window = -1;  // its deadline
  int views = -1;
};

}  // namespace

double CoverageProgram::budget_s(std::size_t segment, double t_s) const {
  const double start_s = times_.earliest_s[segment];
  double budget = t_s - start_s;
  if (times_.has_deadline(segment) && !on_the_way_) {
    const double window_s = times_.deadline_s[segment] - (times_.whole ? start_s : 0.0);
    budget = std::min(budget, window_s + segments_[segment].dearest_s);
  }
  return std::max(0.0, budget);
}

LinearProgram CoverageProgram::at(double t_s, std::size_t last,
                                  const std::vector<bool>& open) const {
  LinearProgram program;
  for (int f = 0; f < fruits_; ++f) program.add_row(0.0);  // z_f − Σ share x ≤ 0
  std::vector<SegmentRows> rows(last + 1);
  for (std::size_t s = 0; s <= last; ++s) {
    SegmentRows& row = rows[s];
    const bool ends = s < last;
    row.chain =
        program.add_row(ends ? -times_.look_s - times_.leave_s[s] - times_.drive_s[s] : t_s);
    if (times_.has_deadline(s)) {
      if (ends && times_.stays && !times_.whole) {
        row.lasts = program.add_row(-times_.deadline_s[s] - times_.drive_s[s]);
      }
      if (!on_the_way_) row.window = program.add_row(times_.deadline_s[s]);
    }
    if (times_.max_views > 0 && !on_the_way_) row.views = program.add_row(times_.max_views);
  }

  using Entry = LinearProgram::Entry;
  std::vector<Entry> entries;
  const auto enter = [&](int row, double value) {
    if (row >= 0) entries.emplace_back(row, value);
  };
  for (int f = 0; f < fruits_; ++f) {
    entries = {{f, 1.0}};
    program.add_column(1.0, 0.0, open[static_cast<std::size_t>(f)] ? 1.0 : 0.0, entries);
  }
  for (std::size_t s = 0; s <= last; ++s) {
    const SegmentRows& row = rows[s];
    entries.clear();  // a_s
    enter(row.chain, 1.0);
    enter(row.lasts, 1.0);
    if (times_.whole) enter(row.window, 1.0);
    if (s > 0) {
      enter(rows[s - 1].chain, -1.0);
      enter(rows[s - 1].lasts, -1.0);
    }
    const double earliest_s = times_.earliest_s[s];
    program.add_column(0.0, earliest_s, std::max(earliest_s, t_s), entries);
    if (row.window >= 0) {  // o_s
      entries = {{row.window, -1.0}};
      program.add_column(0.0, 0.0, segments_[s].dearest_s, entries);
    }
    const std::vector<float>& home = segments_[s].home.share;
    entries.clear();
    for (int f = 0; f < fruits_; ++f) {
      if (home[static_cast<std::size_t>(f)] > 0.0F) {
        entries.emplace_back(f, -home[static_cast<std::size_t>(f)]);
      }
    }
    if (!entries.empty()) program.add_column(0.0, 0.0, 1.0, entries);
    for (const VisitColumn& column : segments_[s].columns) {
      entries.clear();
      for (const auto& [f, share] : column.shares) entries.emplace_back(f, -share);
      enter(row.chain, column.cost_s);
      enter(row.window, column.cost_s);
      enter(row.views, 1.0);
      program.add_column(0.0, 0.0, column.copies, entries);
    }
  }
  return program;
}

}  // namespace canopeer
