#include "canopeer/render/raster_kernels.h"
#include "canopeer/render/shading_kernels.h"

namespace canopeer {

extern const RasterKernels kRasterKernels_scalar;
extern const ShadingKernels kShadingKernels_scalar;
#if defined(__x86_64__)
extern const RasterKernels kRasterKernels_avx2;
extern const RasterKernels kRasterKernels_avx512;
extern const ShadingKernels kShadingKernels_avx2;
extern const ShadingKernels kShadingKernels_avx512;
#endif

const RasterKernels& raster_kernels([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return kRasterKernels_avx512;
  if (level == SimdLevel::avx2) return kRasterKernels_avx2;
#endif
  return kRasterKernels_scalar;
}

const ShadingKernels& shading_kernels([[maybe_unused]] SimdLevel level) {
#if defined(__x86_64__)
  if (level == SimdLevel::avx512) return kShadingKernels_avx512;
  if (level == SimdLevel::avx2) return kShadingKernels_avx2;
#endif
  return kShadingKernels_scalar;
}

}  // namespace canopeer
