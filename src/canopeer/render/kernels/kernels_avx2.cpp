#define CANOPEER_RASTER_NAME kRasterKernels_avx2
#define CANOPEER_SHADING_NAME kShadingKernels_avx2
#include "canopeer/render/raster/raster_body.h"
#include "canopeer/render/shading/shading_body.h"
