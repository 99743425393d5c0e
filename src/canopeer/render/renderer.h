#pragma once

#include <cstdint>
#include <memory>

#include "canopeer/base/simd_level.h"
#include "canopeer/scene/scene.h"
#include "canopeer/sensing/camera_rays.h"
#include "canopeer/sensing/image.h"

namespace canopeer {

/// What each pixel shows, whatever the sensor's range.
struct Labels {
  Image<std::int16_t> fruit;  ///< FruitTruth::id where the body of a fruit is seen, else −1
  Image<std::uint8_t> kind;   ///< PartClass as a number, kNothing where no surface is hit

  static constexpr std::uint8_t kNothing = 255;
};

/// What a camera sees of a scene: three images of one size.
struct RenderedView {
  DepthImage depth;  ///< along the optical axis, metres; 0: nothing within the camera's range
  ColorImage color;
  Labels labels;
};

/// Light, shadow and noise of a rendered view.
struct RenderOptions {
  /// Towards the light, world; any length but 0.
  Vec3 light_direction{0.35, -0.25, 0.9};
  double ambient = 0.6;                ///< share of the light that comes from everywhere, 0 … 1
  bool shadows = false;                ///< one shadow ray a pixel
  double color_noise = 2.0;            ///< half width of triangular noise per channel, grey levels
  std::uint64_t noise_seed = 1;        ///< noise depends on this, the pose and the pixel only
  SimdLevel simd = best_simd_level();  ///< changes the speed, never a bit of the image
};

/// Renders what an RGB-D camera sees of a scene. A pinhole's view is rasterised; rays are cast
/// (with Embree) behind a lens and for shadows. The scene is copied.
class Renderer {
 public:
  explicit Renderer(const Scene& scene, const RenderOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// One view; the ray of a pixel goes through its centre. Colour and labels reach beyond the depth
  /// range. Thread-safe; the same arguments give the same images with any number of threads.
  [[nodiscard]] RenderedView render(const CameraIntrinsics& intrinsics,
                                    const Pose& T_world_camera) const {
    return render(CameraRays(intrinsics), T_world_camera);
  }
  /// The same through a lens; the images are those the lens casts.
  [[nodiscard]] RenderedView render(const CameraRays& rays, const Pose& T_world_camera) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace canopeer
