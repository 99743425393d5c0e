#include "canopeer/report/fruits/fruit_map_svg.h"

#include <fmt/format.h>

#include <algorithm>

#include "canopeer/report/drawing/axis_ticks.h"
#include "canopeer/report/drawing/plot_style.h"
#include "canopeer/report/fruits/fruit_map_legend.h"
#include "canopeer/report/fruits/fruit_silhouette.h"
#include "canopeer/report/fruits/fruit_verdicts.h"

namespace canopeer {
namespace {

constexpr double kLeft = 44.0;
constexpr double kRight = 14.0;
constexpr double kHeadline = 34.0;
constexpr double kAxisRoom = 40.0;
/// A fruit should stay visible however long the row is.
constexpr double kMinPxPerM = 70.0;

/// One picture of the map: what it shows and where it lies.
struct Panel {
  std::string head;
  std::string down_label;
  int down_axis = 2;  ///< of the world
  bool down_is_positive = false;
  bool mirrored = false;  ///< y runs to the left: so it does for who looks along +x
  Box shown;              ///< world
  std::vector<std::size_t> fruits, truths;
  bool cameras = false;
  double top = 0.0;
};

const char* colour_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::near:
      return "c1";
    case Verdict::wrong:
      return "c2";
    case Verdict::green:
      return "c3";
    default:
      return "c0";
  }
}

class FruitMap {
 public:
  FruitMap(const FruitMapInput& input, int width_px)
      : input_(input), verdicts_(fruit_verdicts(input.fruits, input.truth)) {
    find_fruits_found();
    make_panels();
    const double extent = y_high_ - y_low_;
    scale_ = std::max(kMinPxPerM, (width_px - kLeft - kRight) / extent);
    width_ = kLeft + scale_ * extent + kRight;
    legend_ = fruit_map_legend(verdicts_, input.truth, width_px);
    lay_out();
  }

  [[nodiscard]] std::string svg(bool stand_alone) const {
    std::string svg = fmt::format(
        "<svg class=\"map\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\">\n<title>Fruit map: {2} fruits "
        "reported{3}</title>\n",
        width_, height_, input_.fruits.size(),
        input_.truth.empty() ? "" : " and where the true ones are");
    if (stand_alone) {
      svg += "<style>" + std::string(plot_style()) + "</style>\n";
      svg += "<rect width=\"100%\" height=\"100%\" style=\"fill:var(--card)\"/>\n";
    }
    svg += legend_.svg;
    for (const Panel& panel : panels_) svg += panel_svg(panel);
    return svg + "</svg>\n";
  }

 private:
  void find_fruits_found() {
    found_.assign(input_.truth.size(), false);
    for (const FruitVerdict& v : verdicts_) {
      if (v.truth) found_[*v.truth] = true;
    }
  }

  /// Plants left and right of the aisle are two rows; the aisle is where the camera was.
  [[nodiscard]] double aisle_x() const {
    double sum = 0.0;
    for (const Vec3& camera : input_.cameras) sum += camera.x();
    return input_.cameras.empty() ? 0.0 : sum / static_cast<double>(input_.cameras.size());
  }

  [[nodiscard]] Panel row(bool positive_side, double aisle) const {
    Panel panel;
    double sum = 0.0;
    const auto take = [&](const FruitBody& body, std::size_t index,
                          std::vector<std::size_t>& list) {
      if ((body.centre.x() >= aisle) != positive_side) return;
      panel.shown.extend(body.bounds());
      sum += body.centre.x();
      list.push_back(index);
    };
    for (std::size_t i = 0; i < input_.truth.size(); ++i) {
      take(body_of(input_.truth[i]), i, panel.truths);
    }
    for (std::size_t i = 0; i < input_.fruits.size(); ++i) {
      take(body_of(input_.fruits[i]), i, panel.fruits);
    }
    const std::size_t count = panel.truths.size() + panel.fruits.size();
    panel.head = fmt::format("Row at x \u2248 {} m, seen from the aisle",
                             AxisTicks{{}, 2}.label(count ? sum / static_cast<double>(count) : 0));
    panel.down_label = "z / m";
    panel.mirrored = positive_side;
    return panel;
  }

  void make_panels() {
    const double aisle = aisle_x();
    Panel above;
    above.head = input_.on_the_way.empty()
                     ? "From above, camera positions as dots"
                     : "From above, camera positions as dots, on the way as specks";
    above.down_label = "x / m";
    above.down_axis = 0;
    above.down_is_positive = true;
    above.cameras = true;
    for (const bool positive_side : {false, true}) {
      Panel panel = row(positive_side, aisle);
      if (panel.truths.empty() && panel.fruits.empty()) continue;
      above.shown.extend(panel.shown);
      above.truths.insert(above.truths.end(), panel.truths.begin(), panel.truths.end());
      above.fruits.insert(above.fruits.end(), panel.fruits.begin(), panel.fruits.end());
      panels_.push_back(std::move(panel));
    }
    for (const Vec3& camera : input_.cameras) above.shown.extend(camera);
    for (const Vec3& camera : input_.on_the_way) above.shown.extend(camera);
    if (above.shown.isEmpty()) above.shown.extend(Box(Vec3(-1, -1, 0), Vec3(1, 1, 1)));
    if (input_.cameras.empty()) above.head = "From above";
    constexpr double kAirM = 0.05;
    for (Panel& panel : panels_) {
      panel.shown.min().array() -= kAirM;
      panel.shown.max().array() += kAirM;
    }
    above.shown.min().array() -= kAirM;
    above.shown.max().array() += kAirM;
    y_low_ = above.shown.min().y();
    y_high_ = above.shown.max().y();
    panels_.push_back(std::move(above));
  }

  [[nodiscard]] double panel_height(const Panel& panel) const {
    return scale_ * panel.shown.sizes()[panel.down_axis];
  }

  void lay_out() {
    double top = legend_.height_px;
    for (Panel& panel : panels_) {
      panel.top = top + kHeadline;
      top = panel.top + panel_height(panel) + kAxisRoom;
    }
    height_ = top;
  }

  [[nodiscard]] PictureProjection projection(const Panel& panel) const {
    PictureProjection p = PictureProjection::Zero();
    p(0, 1) = panel.mirrored ? -scale_ : scale_;
    p(1, panel.down_axis) = panel.down_is_positive ? scale_ : -scale_;
    return p;
  }

  [[nodiscard]] Eigen::Vector2d origin(const Panel& panel) const {
    const double low = panel.shown.min()[panel.down_axis];
    const double high = panel.shown.max()[panel.down_axis];
    const double left = panel.mirrored ? scale_ * y_high_ : -scale_ * y_low_;
    return {kLeft + left, panel.top + scale_ * (panel.down_is_positive ? -low : high)};
  }

  [[nodiscard]] std::string panel_svg(const Panel& panel) const {
    const PictureProjection p = projection(panel);
    const Eigen::Vector2d o = origin(panel);
    std::string svg = axes(panel, p, o);
    if (panel.cameras) svg += cameras(p, o);
    for (const std::size_t i : panel.fruits) svg += estimate(i, p, o);
    for (const std::size_t i : panel.truths) svg += truth(i, p, o);
    return svg;
  }

  [[nodiscard]] std::string axes(const Panel& panel, const PictureProjection& p,
                                 const Eigen::Vector2d& o) const {
    const double bottom = panel.top + panel_height(panel);
    const double right = width_ - kRight;
    std::string svg = fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"head\">{}</text>\n",
                                  kLeft, panel.top - 12.0, panel.head);
    svg +=
        fmt::format("<text x=\"0\" y=\"{:.1f}\">{}</text>\n", panel.top - 12.0, panel.down_label);
    const AxisTicks across = axis_ticks(y_low_, y_high_, static_cast<int>((right - kLeft) / 70.0));
    for (const double tick : across.values) {
      const double x = o.x() + p(0, 1) * tick;
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" class=\"grid\"/>"
          "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4}</text>\n",
          x, panel.top, bottom, bottom + 15.0, across.label(tick));
    }
    const int axis = panel.down_axis;
    const AxisTicks down = axis_ticks(panel.shown.min()[axis], panel.shown.max()[axis],
                                      std::max(3, static_cast<int>((bottom - panel.top) / 40.0)));
    for (const double tick : down.values) {
      const double y = o.y() + p(1, axis) * tick;
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" y1=\"{2:.1f}\" x2=\"{1:.1f}\" y2=\"{2:.1f}\" class=\"grid\"/>"
          "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
          kLeft, right, y, kLeft - 6.0, y + 4.0, down.label(tick));
    }
    return svg + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">y / m</text>\n",
                             right, bottom + 31.0);
  }

  /// There may be thousands: those that lie on the one before are left out.
  [[nodiscard]] std::string specks(const PictureProjection& p, const Eigen::Vector2d& o) const {
    std::string marks;
    Eigen::Vector2d last = Eigen::Vector2d::Constant(-1e9);
    for (const Vec3& camera : input_.on_the_way) {
      const Eigen::Vector2d at = o + p * camera;
      if ((at - last).norm() < 1.0) continue;
      last = at;
      marks += fmt::format("M{:.1f} {:.1f}h0", at.x(), at.y());
    }
    return marks.empty() ? marks : "<path class=\"speck\" d=\"" + marks + "\"/>";
  }

  [[nodiscard]] std::string cameras(const PictureProjection& p, const Eigen::Vector2d& o) const {
    std::string dots = specks(p, o);
    for (const Vec3& camera : input_.cameras) {
      const Eigen::Vector2d at = o + p * camera;
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.8\"/>", at.x(), at.y());
    }
    return "<g class=\"camera\">" + dots + "</g>\n";
  }

  [[nodiscard]] std::string estimate(std::size_t i, const PictureProjection& p,
                                     const Eigen::Vector2d& o) const {
    const FruitEstimate& fruit = input_.fruits[i];
    const FruitVerdict& v = verdicts_[i];
    const std::string attributes = fmt::format("class=\"solid {}\"", colour_of(v.verdict));
    std::string title = fmt::format("fruit {}, {:.0f} cm\u00b3", fruit.id, fruit.volume_cm3);
    if (v.verdict == Verdict::wrong) {
      const double r = std::max(5.0, scale_ * fruit.semi_axes_m.maxCoeff());
      return diamond_svg(o + p * fruit.centre, r, attributes, title + ", no fruit there");
    }
    std::string svg;
    if (v.truth) {
      title += fmt::format(", {:.1f} cm from true fruit {}", 100.0 * v.distance_m,
                           input_.truth[*v.truth].id);
    }
    if (v.verdict == Verdict::near) {
      const Eigen::Vector2d a = o + p * fruit.centre;
      const Eigen::Vector2d b = o + p * input_.truth[*v.truth].centre;
      svg += fmt::format(
          "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"thin c1\"/>\n",
          a.x(), a.y(), b.x(), b.y());
    }
    return svg + silhouette_svg(body_of(fruit), p, o, attributes, title);
  }

  [[nodiscard]] std::string truth(std::size_t i, const PictureProjection& p,
                                  const Eigen::Vector2d& o) const {
    const FruitTruth& fruit = input_.truth[i];
    const char* css_class = "thin c3";
    std::string title = fmt::format("true fruit {}", fruit.id);
    if (fruit.counted) {
      css_class = found_[i] ? "truth" : "missed";
      if (!found_[i]) title += ", not found";
    } else {
      title += ", green: does not count";
    }
    return silhouette_svg(body_of(fruit), p, o, fmt::format("class=\"{}\"", css_class), title);
  }

  const FruitMapInput& input_;
  std::vector<FruitVerdict> verdicts_;
  std::vector<bool> found_;  ///< per true fruit
  std::vector<Panel> panels_;
  double y_low_ = 0.0, y_high_ = 1.0;
  double scale_ = kMinPxPerM;  ///< px per m
  double width_ = 0.0, height_ = 0.0;
  FruitMapLegend legend_;
};

}  // namespace

std::string fruit_map_svg(const FruitMapInput& input, int width_px, bool stand_alone) {
  return FruitMap(input, width_px).svg(stand_alone);
}

}  // namespace canopeer
