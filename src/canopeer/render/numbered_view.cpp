#include "canopeer/render/numbered_view.h"

#include <algorithm>

#include "canopeer/base/check.h"
#include "canopeer/render/raster/rasterizer.h"

namespace canopeer {
namespace {

/// In the order in which a soup has the triangles of the parts with numbers.
std::vector<std::uint32_t> numbers_of(const std::vector<NumberedPart>& parts) {
  std::vector<std::uint32_t> numbers;
  for (const bool holes : {false, true}) {
    for (const NumberedPart& p : parts) {
      if (p.numbers.empty() || p.part.see_through || has_holes(p.part) != holes) continue;
      CANOPEER_CHECK(p.numbers.size() == p.part.mesh.triangles.size(), "a number per triangle");
      numbers.insert(numbers.end(), p.numbers.begin(), p.numbers.end());
    }
  }
  return numbers;
}

SurfaceSoup numbered_soup(const std::vector<NumberedPart>& parts, bool with_numbers) {
  std::vector<ScenePart> plain;
  for (const NumberedPart& p : parts) {
    if (p.numbers.empty() != with_numbers) plain.push_back(p.part);
  }
  return make_surface_soup(plain);
}

}  // namespace

struct NumberedView::Impl {
  explicit Impl(const std::vector<NumberedPart>& parts)
      : soup(numbered_soup(parts, true)),
        others(numbered_soup(parts, false)),
        numbers(numbers_of(parts)),
        clusters(make_triangle_clusters(soup)),
        other_clusters(make_triangle_clusters(others)),
        rasterizer(
            {{&soup, &clusters, Pose::Identity()}, {&others, &other_clusters, Pose::Identity()}}) {
    CANOPEER_CHECK(numbers.size() == soup.triangles.size(), "the soup keeps the parts' order");
  }

  SurfaceSoup soup;                    // of the parts with numbers
  SurfaceSoup others;                  // of those without, which hide them
  std::vector<std::uint32_t> numbers;  // per triangle of the soup
  TriangleClusters clusters;
  TriangleClusters other_clusters;
  Rasterizer rasterizer;
};

NumberedView::NumberedView(const std::vector<NumberedPart>& parts)
    : impl_(std::make_unique<Impl>(parts)) {}
NumberedView::~NumberedView() = default;
NumberedView::NumberedView(NumberedView&&) noexcept = default;
NumberedView& NumberedView::operator=(NumberedView&&) noexcept = default;

void NumberedView::see(const CameraIntrinsics& camera, const Pose& T_world_camera,
                       std::vector<std::uint32_t>& numbers) const {
  numbers.clear();
  const auto nearest = static_cast<float>(1.0 / camera.min_range_m);  // ∞ for a range from 0
  const auto farthest = static_cast<float>(1.0 / camera.max_range_m);
  const VisibleImage image = impl_->rasterizer.draw_first_body(
      camera, T_world_camera, static_cast<float>(camera.max_range_m));
  std::vector<VisibleRun> runs;
  for (int v = 0; v < camera.height; ++v) {
    image.row(v, &runs);
    const float* nearness = image.nearness_row(v);
    for (const VisibleRun& run : runs) {
      if (run.surface.body != 0) continue;
      const std::uint32_t number = impl_->numbers[run.surface.triangle];
      if (number == NumberedPart::kNone) continue;
      const bool in_range = std::any_of(nearness + run.begin, nearness + run.end,
                                        [&](float n) { return n <= nearest && n >= farthest; });
      if (in_range) numbers.push_back(number);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace canopeer
