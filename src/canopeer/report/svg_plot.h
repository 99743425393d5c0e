#pragma once

#include <string>
#include <utility>
#include <vector>

#include "canopeer/report/sample_spread.h"

namespace canopeer {

/// Text around a plot; axis labels carry their unit ("mission time / s").
struct PlotLabels {
  std::string title;  ///< for readers who cannot see it
  std::string x;
  std::string y;
};

/// A plot of lines, steps or boxes as inline SVG. Colours and fonts come from plot_style(), so the
/// plot follows the light or dark theme of its page. Series are named in a legend when they have a
/// name; `colour` is 0 … 5. Ranges grow to hold everything added. Same calls, same bytes.
class SvgPlot {
 public:
  using Points = std::vector<std::pair<double, double>>;

  explicit SvgPlot(PlotLabels labels) : labels_(std::move(labels)) {}

  void add_line(std::string name, int colour, Points points);
  /// The value holds until the next point.
  void add_steps(std::string name, int colour, const Points& points);
  /// The area between two curves, behind the lines; points are (x, low) and (x, high) with the same
  /// x each.
  void add_band(int colour, const Points& low, const Points& high);
  /// Dots, no line between them.
  void add_dots(std::string name, int colour, Points points);
  /// Boxes stand side by side over their labels; not to be mixed with lines.
  void add_box(std::string label, int colour, SampleSpread spread);
  /// Thin line across the plot, e.g. where a segment begins; the label may be empty.
  void mark_x(double x, std::string label);
  /// Dashed line, e.g. the number of fruits there are.
  void mark_y(double y, std::string label);
  void include(double x, double y);
  /// The y axis counts something: ticks at whole numbers only.
  void set_y_whole(bool whole) { y_whole_ = whole; }

  /// `width_px` × `height_px` are the size it is meant to be shown at: text keeps its size, narrow
  /// plots get fewer ticks.
  [[nodiscard]] std::string svg(int width_px, int height_px) const;
  /// The same as a file of its own, with colours and background inside.
  [[nodiscard]] std::string svg_file(int width_px, int height_px) const;

 private:
  struct Series {
    std::string name;
    int colour = 0;
    Points points;
    bool dots = false;
  };
  struct Band {
    int colour = 0;
    Points outline;
  };
  struct BoxSeries {
    std::string label;
    int colour = 0;
    SampleSpread spread;
  };
  struct Mark {
    double at = 0.0;
    std::string label;
  };
  struct Frame;
  [[nodiscard]] Frame frame(int width_px, int height_px) const;
  [[nodiscard]] std::string axes_svg(const Frame& f) const;
  [[nodiscard]] std::string marks_svg(const Frame& f) const;
  [[nodiscard]] std::string bands_svg(const Frame& f) const;
  [[nodiscard]] std::string lines_svg(const Frame& f) const;
  [[nodiscard]] std::string dots_svg(const Frame& f, const Series& series) const;
  [[nodiscard]] std::string boxes_svg(const Frame& f) const;
  [[nodiscard]] std::string legend_svg(const Frame& f) const;

  PlotLabels labels_;
  std::vector<Series> series_;
  std::vector<Band> bands_;
  std::vector<BoxSeries> boxes_;
  std::vector<Mark> x_marks_;
  std::vector<Mark> y_marks_;
  bool y_whole_ = false;
  bool empty_ = true;
  double x_low_ = 0.0, x_high_ = 1.0, y_low_ = 0.0, y_high_ = 1.0;
};

}  // namespace canopeer
