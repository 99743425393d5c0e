#pragma once

#include "canopeer/map/fusion/frame_kernels.h"

namespace canopeer {

// The parts frame_kernels() puts together; `level` must be one the machine has.

using EndPointRowKernel = decltype(FrameKernels::end_point_row);
EndPointRowKernel end_point_row_kernel(SimdLevel level);

using FirstPixelsKernel = decltype(FrameKernels::first_pixels);
FirstPixelsKernel first_pixels_kernel(SimdLevel level);

using FreeInBlockKernel = decltype(FrameKernels::free_in_block);
FreeInBlockKernel free_in_block_kernel(SimdLevel level);

struct PyramidKernels {
  decltype(FrameKernels::coarsen) coarsen;
  decltype(FrameKernels::halve) halve;
  decltype(FrameKernels::widen) widen;
  decltype(FrameKernels::classify) classify;
};
PyramidKernels pyramid_kernels(SimdLevel level);

}  // namespace canopeer
