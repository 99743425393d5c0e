#include "canopeer/map/fusion/frame_kernels.h"

#include "canopeer/map/fusion/frame_kernel_parts.h"

namespace canopeer {
namespace {

FrameKernels kernels_of(SimdLevel level) {
  const PyramidKernels pyramid = pyramid_kernels(level);
  return {end_point_row_kernel(level),
          first_pixels_kernel(level),
          pyramid.coarsen,
          pyramid.halve,
          pyramid.widen,
          pyramid.classify,
          free_in_block_kernel(level)};
}

}  // namespace

const FrameKernels& frame_kernels(SimdLevel level) {
  static const FrameKernels kKernels[] = {
      kernels_of(SimdLevel::scalar), kernels_of(SimdLevel::narrow), kernels_of(SimdLevel::avx2),
      kernels_of(SimdLevel::avx512)};
  return kKernels[static_cast<std::size_t>(level)];
}

}  // namespace canopeer
