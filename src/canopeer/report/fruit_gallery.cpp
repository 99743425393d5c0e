#include "canopeer/report/fruit_gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "canopeer/report/drawing/plot_style.h"
#include "canopeer/report/fruits/fruit_silhouette.h"
#include "canopeer/report/html_text.h"

namespace canopeer {
namespace {

constexpr double kPxPerM = 1100.0;
constexpr double kViewPx = 128.0;  // side of a view; a fruit of 11 cm fits
constexpr double kTextHeight = 66.0;
constexpr double kGapPx = 14.0;
constexpr double kCardWidth = 2.0 * kViewPx + kGapPx;
constexpr double kCardHeight = kViewPx + kTextHeight + kGapPx;
constexpr std::size_t kMaxPoints = 350;  // shown; more hide each other

using Point2 = Eigen::Vector2d;

double cross(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Convex hull by monotone chain (Andrew 1979).
std::vector<Point2> hull_of(std::vector<Point2> points) {
  std::sort(points.begin(), points.end(), [](const Point2& a, const Point2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Point2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t begin = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// One of the two views: where a point of the world comes to lie.
struct View {
  PictureProjection projection;
  Vec3 centre;
  Point2 middle;

  [[nodiscard]] Point2 at(const Vec3& p) const { return middle + projection * (p - centre); }
};

/// Superellipsoids with exponents up to 1 are convex, so the outline is the hull of the samples.
std::string outline(const Superellipsoid& body, const View& view) {
  std::vector<Point2> samples;
  for (const SurfacePoint& s : body.surface_samples(600)) samples.push_back(view.at(s.point));
  std::string path;
  for (const Point2& p : hull_of(std::move(samples))) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.x(), p.y());
  }
  return fmt::format("<path d=\"{}z\" class=\"shape\"/>\n", path);
}

std::string points_svg(const GalleryFruit& fruit, const View& view) {
  std::string svg;
  const std::size_t stride = (fruit.points.size() + kMaxPoints - 1) / kMaxPoints;
  for (std::size_t i = 0; i < fruit.points.size(); i += std::max<std::size_t>(1, stride)) {
    const Point2 p = view.at(fruit.points[i]);
    if ((p - view.middle).cwiseAbs().maxCoeff() > 0.5 * kViewPx) continue;
    const Rgb c = i < fruit.colors.size() ? fruit.colors[i] : Rgb{120, 120, 120};
    svg +=
        fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.6\" fill=\"#{:02x}{:02x}{:02x}\"/>",
                    p.x(), p.y(), c.r, c.g, c.b);
  }
  for (const Vec3& m : fruit.missing) {
    const Point2 p = view.at(m);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.2\" class=\"unseen\"/>", p.x(),
                       p.y());
  }
  return svg + "\n";
}

std::string view_svg(const GalleryFruit& fruit, bool along_x, const Point2& corner) {
  View view;
  view.centre = fruit.estimate.centre;
  view.middle = corner + Point2::Constant(0.5 * kViewPx);
  view.projection.setZero();
  view.projection(0, along_x ? 1 : 0) = kPxPerM;
  view.projection(1, 2) = -kPxPerM;
  std::string svg = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" class=\"frame\"/>\n"
      "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"tiny\">{}</text>\n",
      corner.x(), corner.y(), kViewPx, kViewPx, corner.x() + 4.0, corner.y() + kViewPx - 5.0,
      along_x ? "y, z" : "x, z");
  svg += points_svg(fruit, view);
  if (fruit.truth) {
    const FruitBody truth = body_of(*fruit.truth);
    const Point2 at = view.at(truth.centre);
    if ((at - view.middle).cwiseAbs().maxCoeff() < 0.6 * kViewPx) {
      svg += silhouette_svg(truth, view.projection, at - view.projection * truth.centre,
                            "class=\"truth\"", "true size");
    }
  }
  return svg + outline(fruit.estimate.body(), view);
}

std::string card_svg(const GalleryFruit& fruit, const Point2& corner) {
  const FruitEstimate& e = fruit.estimate;
  std::string svg = "<g>\n";
  const std::string what = fruit.verdict.empty() ? std::string() : ": " + fruit.verdict;
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"head\">Fruit {}{}</text>\n",
                     corner.x(), corner.y() + 12.0, e.id, escape_html(what));
  std::string volume = fmt::format("{:.0f} ± {:.0f} cm³", e.volume_cm3, e.volume_sd_cm3);
  if (fruit.truth) volume += fmt::format(" (true {:.0f})", fruit.truth->volume_cm3);
  svg += fmt::format(
      "<text x=\"{0:.1f}\" y=\"{1:.1f}\">{3}</text>\n<text x=\"{0:.1f}\" y=\"{2:.1f}\">{4:.0f} % "
      "seen, "
      "confidence {5:.2f}</text>\n",
      corner.x(), corner.y() + 29.0, corner.y() + 45.0, volume, 100.0 * e.seen_share, e.confidence);
  const Point2 views = corner + Point2(0.0, kTextHeight - 10.0);
  svg += view_svg(fruit, true, views);
  svg += view_svg(fruit, false, views + Point2(kViewPx + 0.5 * kGapPx, 0.0));
  return svg + "</g>\n";
}

constexpr const char* kGalleryStyle =
    ".gallery .frame{fill:none;stroke:var(--rule)}.gallery .shape{fill:none;stroke:var(--c0);"
    "stroke-width:1.6}.gallery .truth{stroke-dasharray:3 3}.gallery .unseen{fill:var(--c0);"
    "fill-opacity:.35}.gallery .tiny{font-size:10px}";

}  // namespace

std::string fruit_gallery_svg(const std::vector<GalleryFruit>& fruits, int width_px,
                              bool stand_alone) {
  const int columns = std::max(1, static_cast<int>((width_px + kGapPx) / (kCardWidth + kGapPx)));
  const int rows = (static_cast<int>(fruits.size()) + columns - 1) / columns;
  const double width = columns * (kCardWidth + kGapPx);
  const double height = std::max(1.0, rows * kCardHeight);
  std::string svg = fmt::format(
      "<svg class=\"gallery\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\">\n<title>Fitted shapes over the points "
      "they "
      "were fitted to</title>\n<style>{2}{3}</style>\n",
      width, height, stand_alone ? plot_style() : "", kGalleryStyle);
  if (stand_alone) svg += "<rect width=\"100%\" height=\"100%\" style=\"fill:var(--card)\"/>\n";
  for (std::size_t i = 0; i < fruits.size(); ++i) {
    const int column = static_cast<int>(i) % columns;
    const int row = static_cast<int>(i) / columns;
    svg += card_svg(fruits[i], {4.0 + column * (kCardWidth + kGapPx), row * kCardHeight});
  }
  return svg + "</svg>\n";
}

}  // namespace canopeer
