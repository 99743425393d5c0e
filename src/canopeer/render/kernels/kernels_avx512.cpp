#define CANOPEER_RASTER_NAME kRasterKernels_avx512
#define CANOPEER_SHADING_NAME kShadingKernels_avx512
#include "canopeer/render/raster/raster_body.h"
#include "canopeer/render/shading/shading_body.h"
