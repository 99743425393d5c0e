#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "canopeer/record/fruit_course.h"
#include "canopeer/report/html_parts.h"
#include "canopeer/report/html_text.h"
#include "canopeer/report/sections/report_sections.h"

namespace canopeer {
namespace {

/// What became of frames during one kind of motion.
struct FramesDuring {
  const char* name;
  std::string kind;  // of the motion
  int motions = 0;
  FrameCounts counts{};
  std::int64_t gain = 0;  // voxels newly known
};

std::array<FramesDuring, 3> by_motion(const RunRecord& record) {
  std::array<FramesDuring, 3> all{FramesDuring{"to a view", "view"}, FramesDuring{"home", "home"},
                                  FramesDuring{"trolley and lift", "trolley"}};
  for (FramesDuring& during : all) {
    for (const MotionEvent& motion : record.motions) {
      if (motion.kind != during.kind || !motion.frames) continue;
      ++during.motions;
      during.counts.fused += motion.frames->fused;
      during.counts.late += motion.frames->late;
      during.counts.blurred += motion.frames->blurred;
      during.counts.alike += motion.frames->alike;
      during.counts.unread += motion.frames->unread;
    }
    for (const FrameEvent& frame : record.frames) {
      if (frame.during == during.kind) during.gain += frame.realised_gain;
    }
  }
  return all;
}

std::string motion_table(const RunRecord& record) {
  std::vector<std::vector<std::string>> rows;
  for (const FramesDuring& d : by_motion(record)) {
    if (d.motions == 0) continue;
    rows.push_back({d.name, std::to_string(d.motions), count_text(d.counts.fused),
                    count_text(d.counts.late), count_text(d.counts.blurred),
                    count_text(d.counts.alike), count_text(d.counts.unread), count_text(d.gain)});
  }
  return html_table({"On the way", "motions", "taken in", "late", "blurred", "alike", "unread",
                     "voxels<br>newly known"},
                    rows) +
         "<p class=\"note\">Late: they came while too many waited. Blurred: more than the mission "
         "allows. Alike: the camera had hardly moved. Unread: their images could not be "
         "read.</p>\n";
}

/// Where fruits and voxels were first seen, at views or between them.
std::string shares(const RunFiles& files) {
  int fruits_on_the_way = 0;
  int fruits_at_views = 0;
  const auto first = first_known(fruit_course(files.record));
  for (const FruitEstimate& fruit : files.fruits) {
    const auto known = first.find(fruit.id);
    if (known == first.end()) continue;
    ++(known->second.on_the_way ? fruits_on_the_way : fruits_at_views);
  }
  std::int64_t gain_on_the_way = 0;
  std::int64_t gain_at_views = 0;
  for (const FrameEvent& frame : files.record.frames) gain_on_the_way += frame.realised_gain;
  for (const ViewEvent& view : files.record.views) gain_at_views += view.realised_gain;
  return fmt::format(
      "<p>Of the reported fruits {} were first known on the way, {} at a view. Voxels newly known: "
      "{} on the way, {} at views.</p>\n",
      fruits_on_the_way, fruits_at_views, count_text(gain_on_the_way), count_text(gain_at_views));
}

SvgPlot blur_plot(const std::vector<FrameEvent>& frames) {
  constexpr int kBins = 20;
  double most_px = 0.1;
  for (const FrameEvent& frame : frames) most_px = std::max(most_px, frame.blur_px);
  const double bin_px = most_px / kBins;
  std::array<int, kBins> counts{};
  for (const FrameEvent& frame : frames) {
    const int bin = std::clamp(static_cast<int>(frame.blur_px / bin_px), 0, kBins - 1);
    ++counts[static_cast<std::size_t>(bin)];
  }
  SvgPlot::Points points;
  for (int i = 0; i < kBins; ++i) {
    points.emplace_back(bin_px * i, counts[static_cast<std::size_t>(i)]);
  }
  points.emplace_back(most_px, 0.0);
  SvgPlot plot({"Blur of frames on the way", "image motion during the exposure / px", "frames"});
  plot.set_y_whole(true);
  plot.include(0.0, 0.0);
  plot.add_steps("", 0, points);
  return plot;
}

}  // namespace

std::string frames_section(const ReportData& data) {
  const RunRecord& record = data.files.record;
  if (!data.files.summary.frames_fused && record.frames.empty()) return {};
  std::string html = shares(data.files) + motion_table(record);
  if (!record.frames.empty()) html += html_plot(blur_plot(record.frames), 200, 180);
  return html_section("Frames on the way", html);
}

}  // namespace canopeer
