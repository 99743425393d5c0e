#include "canopeer/render/raster/raster_kernels.h"
#include "canopeer/render/shading/shading_kernels.h"

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
  return CANOPEER_AT_LEVEL(level, kRasterKernels);
}

const ShadingKernels& shading_kernels([[maybe_unused]] SimdLevel level) {
  return CANOPEER_AT_LEVEL(level, kShadingKernels);
}

}  // namespace canopeer
