#include "canopeer/report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "canopeer/report/drawing/axis_ticks.h"
#include "canopeer/report/drawing/plot_style.h"
#include "canopeer/report/html_text.h"

namespace canopeer {
namespace {

constexpr double kTextPx = 12.0;  // as in plot_style()
constexpr double kLinePx = 18.0;

/// Good enough for placing text: the real font is the reader's.
double text_width(const std::string& text) {
  const auto continuation = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  const auto letters = std::count_if(text.begin(), text.end(), std::not_fn(continuation));
  return 0.56 * kTextPx * static_cast<double>(letters);
}

std::string text_at(double x, double y, const char* anchor, const char* css_class,
                    const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n",
                     x, y, anchor, css_class, escape_html(text));
}

std::string line_at(double x1, double y1, double x2, double y2, const std::string& css_class) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x1, y1, x2,
      y2, css_class);
}

}  // namespace

/// Where the plot area lies in the picture, and the ticks along it.
struct SvgPlot::Frame {
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
  double x_low = 0.0, x_high = 1.0, y_low = 0.0, y_high = 1.0;
  double legend_top = 0.0;
  AxisTicks x_ticks, y_ticks;

  [[nodiscard]] double x(double value) const {
    return left + (value - x_low) / (x_high - x_low) * (right - left);
  }
  [[nodiscard]] double y(double value) const {
    return bottom - (value - y_low) / (y_high - y_low) * (bottom - top);
  }
};

void SvgPlot::include(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  x_low_ = empty_ ? x : std::min(x_low_, x);
  x_high_ = empty_ ? x : std::max(x_high_, x);
  y_low_ = empty_ ? y : std::min(y_low_, y);
  y_high_ = empty_ ? y : std::max(y_high_, y);
  empty_ = false;
}

void SvgPlot::add_line(std::string name, int colour, Points points) {
  for (const auto& [x, y] : points) include(x, y);
  series_.push_back({std::move(name), colour, std::move(points), false});
}

void SvgPlot::add_band(int colour, const Points& low, const Points& high) {
  Band band{colour, low};
  band.outline.insert(band.outline.end(), high.rbegin(), high.rend());
  for (const auto& [x, y] : band.outline) include(x, y);
  bands_.push_back(std::move(band));
}

void SvgPlot::add_dots(std::string name, int colour, Points points) {
  for (const auto& [x, y] : points) include(x, y);
  series_.push_back({std::move(name), colour, std::move(points), true});
}

void SvgPlot::add_steps(std::string name, int colour, const Points& points) {
  Points corners;
  for (const auto& [x, y] : points) {
    const bool rises = !corners.empty() && corners.back().second != y;
    // A flat stretch needs no corner in between: its end comes with the next rise.
    if (corners.empty() || rises || x == points.back().first) {
      if (rises) corners.emplace_back(x, corners.back().second);
      corners.emplace_back(x, y);
    }
  }
  add_line(std::move(name), colour, std::move(corners));
}

void SvgPlot::add_box(std::string label, int colour, SampleSpread spread) {
  const double middle = static_cast<double>(boxes_.size());
  include(middle - 0.5, 0.0);
  include(middle + 0.5, spread.upper_whisker);
  if (!spread.outliers.empty()) include(middle, spread.outliers.back());
  boxes_.push_back({std::move(label), colour, std::move(spread)});
}

void SvgPlot::mark_x(double x, std::string label) { x_marks_.push_back({x, std::move(label)}); }

void SvgPlot::mark_y(double y, std::string label) {
  include(empty_ ? 0.0 : x_low_, y);
  y_marks_.push_back({y, std::move(label)});
}

SvgPlot::Frame SvgPlot::frame(int width_px, int height_px) const {
  Frame f;
  f.x_low = x_low_;
  f.x_high = x_high_ > x_low_ ? x_high_ : x_low_ + 1.0;
  f.y_low = y_low_;
  // A little air, so that the highest line does not lie on the border.
  f.y_high = y_high_ > y_low_ ? y_high_ + 0.04 * (y_high_ - y_low_) : y_low_ + 1.0;
  f.y_ticks = axis_ticks(f.y_low, f.y_high, std::max(2, height_px / 55), y_whole_);
  double label_width = 0.0;
  for (const double tick : f.y_ticks.values) {
    label_width = std::max(label_width, text_width(f.y_ticks.label(tick)));
  }
  f.left = label_width + 12.0;
  f.right = width_px - 10.0;
  f.x_ticks = axis_ticks(f.x_low, f.x_high, std::max(2, width_px / 80));
  f.legend_top = kLinePx;
  double legend_x = f.left;
  bool named = false;
  for (const Series& s : series_) {
    if (s.name.empty()) continue;
    const double width = text_width(s.name) + 40.0;
    if (named && legend_x + width > width_px) {
      legend_x = f.left;
      f.legend_top += kLinePx;
    }
    named = true;
    legend_x += width;
  }
  f.top = f.legend_top + (named ? kLinePx : 0.0) + (x_marks_.empty() ? 8.0 : 20.0);
  f.legend_top = kLinePx;
  f.bottom = height_px - (labels_.x.empty() ? 24.0 : 42.0);
  return f;
}

std::string SvgPlot::axes_svg(const Frame& f) const {
  std::string svg = text_at(0.0, 12.0, "start", "label", labels_.y);
  for (const double tick : f.y_ticks.values) {
    svg += line_at(f.left, f.y(tick), f.right, f.y(tick), "grid");
    svg += text_at(f.left - 6.0, f.y(tick) + 4.0, "end", "tick", f.y_ticks.label(tick));
  }
  svg += line_at(f.left, f.bottom, f.right, f.bottom, "axis");
  if (boxes_.empty()) {
    for (const double tick : f.x_ticks.values) {
      svg += line_at(f.x(tick), f.bottom, f.x(tick), f.bottom + 4.0, "axis");
      svg += text_at(f.x(tick), f.bottom + 17.0, "middle", "tick", f.x_ticks.label(tick));
    }
  }
  svg += text_at(0.5 * (f.left + f.right), f.bottom + 36.0, "middle", "label", labels_.x);
  return svg;
}

std::string SvgPlot::marks_svg(const Frame& f) const {
  std::string svg;
  double free_from = f.left - 1.0;
  for (const Mark& mark : x_marks_) {
    const double x = f.x(mark.at);
    svg += line_at(x, f.top - 4.0, x, f.bottom, "mark");
    if (mark.label.empty() || x < free_from) continue;
    if (x + text_width(mark.label) > f.right + 8.0) continue;
    svg += text_at(x + 3.0, f.top - 6.0, "start", "tick", mark.label);
    free_from = x + text_width(mark.label) + 8.0;
  }
  for (const Mark& mark : y_marks_) {
    svg += line_at(f.left, f.y(mark.at), f.right, f.y(mark.at), "goal");
    // On the left, where courses that grow towards the mark have not got to it.
    svg += text_at(f.left + 4.0, f.y(mark.at) + 14.0, "start", "tick", mark.label);
  }
  return svg;
}

std::string SvgPlot::bands_svg(const Frame& f) const {
  std::string svg;
  for (const Band& band : bands_) {
    std::string points;
    for (const auto& [x, y] : band.outline) points += fmt::format("{:.1f},{:.1f} ", f.x(x), f.y(y));
    svg += fmt::format("<polygon class=\"band c{}\" points=\"{}\"/>\n", band.colour % 6, points);
  }
  return svg;
}

std::string SvgPlot::dots_svg(const Frame& f, const Series& series) const {
  std::string svg;
  for (const auto& [x, y] : series.points) {
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.8\" class=\"dot c{}\"/>\n",
                       f.x(x), f.y(y), series.colour % 6);
  }
  return svg;
}

std::string SvgPlot::lines_svg(const Frame& f) const {
  std::string svg;
  // An earlier line is wider, so that it still shows where a later one lies on it.
  const double step = bands_.empty() ? 1.8 : 0.0;
  double width = 2.0 + step * static_cast<double>(series_.size());
  for (const Series& series : series_) {
    width -= step;
    if (series.dots) {
      svg += dots_svg(f, series);
      continue;
    }
    std::string points;
    for (const auto& [x, y] : series.points) {
      if (std::isfinite(x) && std::isfinite(y)) {
        points += fmt::format("{:.1f},{:.1f} ", f.x(x), f.y(y));
      }
    }
    svg += fmt::format(
        "<polyline class=\"line c{}\" style=\"stroke-width:{:.1f}px\" points=\"{}\"/>\n",
        series.colour % 6, width, points);
  }
  return svg;
}

std::string SvgPlot::boxes_svg(const Frame& f) const {
  std::string svg;
  double free_from = f.left - 20.0;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const BoxSeries& box = boxes_[i];
    const SampleSpread& s = box.spread;
    const double middle = f.x(static_cast<double>(i));
    const double half = std::min(26.0, 0.3 * (f.x(1.0) - f.x(0.0)));
    const std::string colour = fmt::format("c{}", box.colour % 6);
    const double label_half = 0.5 * text_width(box.label);
    if (middle - label_half > free_from) {
      svg += text_at(middle, f.bottom + 17.0, "middle", "tick", box.label);
      free_from = middle + label_half + 4.0;
    }
    if (s.count == 0) continue;
    svg +=
        fmt::format("<g><title>{}: median {:.2f}, quartiles {:.2f} and {:.2f}, n = {}</title>\n",
                    escape_html(box.label), s.median, s.lower_quartile, s.upper_quartile, s.count);
    svg += line_at(middle, f.y(s.lower_whisker), middle, f.y(s.lower_quartile), "thin " + colour);
    svg += line_at(middle, f.y(s.upper_quartile), middle, f.y(s.upper_whisker), "thin " + colour);
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"box {}\"/>\n",
        middle - half, f.y(s.upper_quartile), 2.0 * half,
        std::max(1.0, f.y(s.lower_quartile) - f.y(s.upper_quartile)), colour);
    svg += line_at(middle - half, f.y(s.median), middle + half, f.y(s.median), "line " + colour);
    for (const double value : s.outliers) {
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\" class=\"thin {}\"/>\n",
                         middle, f.y(value), colour);
    }
    svg += "</g>\n";
  }
  return svg;
}

std::string SvgPlot::legend_svg(const Frame& f) const {
  std::string svg;
  double x = f.left;
  double y = f.legend_top + 12.0;
  for (const Series& series : series_) {
    if (series.name.empty()) continue;
    const double width = text_width(series.name) + 40.0;
    if (x > f.left && x + width > f.right + 10.0) {
      x = f.left;
      y += kLinePx;
    }
    svg += line_at(x, y - 4.0, x + 18.0, y - 4.0, fmt::format("line c{}", series.colour % 6));
    svg += text_at(x + 24.0, y, "start", "label", series.name);
    x += width;
  }
  return svg;
}

std::string SvgPlot::svg(int width_px, int height_px) const {
  const Frame f = frame(width_px, height_px);
  return fmt::format(
             "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
             "width=\"{0}\" height=\"{1}\" role=\"img\">\n<title>{2}</title>\n",
             width_px, height_px, escape_html(labels_.title)) +
         axes_svg(f) + marks_svg(f) + bands_svg(f) + boxes_svg(f) + lines_svg(f) + legend_svg(f) +
         "</svg>\n";
}

std::string SvgPlot::svg_file(int width_px, int height_px) const {
  std::string text = svg(width_px, height_px);
  text.insert(text.find('\n') + 1,
              "<style>" + std::string(plot_style()) +
                  "</style>\n<rect width=\"100%\" height=\"100%\" style=\"fill:var(--card)\"/>\n");
  return text;
}

}  // namespace canopeer
