#define CANOPEER_RASTER_NAME kRasterKernels_scalar
#define CANOPEER_SHADING_NAME kShadingKernels_scalar
#include "canopeer/render/raster/raster_body.h"
#include "canopeer/render/shading/shading_body.h"
