#define CANOPEER_RASTER_NAME kRasterKernels_scalar
#define CANOPEER_SHADING_NAME kShadingKernels_scalar
#include "canopeer/render/raster_body.h"
#include "canopeer/render/shading_body.h"
