#pragma once

// Embree 3 (Debian 12) or 4 (Debian 13), whichever is there. What differs between them stands here.

#include <span>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace canopeer::embree {

/// Fills in each ray's hit. Quick when the rays are neighbours in an image. Thread-safe.
inline void closest_of_neighbors(RTCScene scene, std::span<RTCRayHit> rays) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  // Embree 4 has no streams.
  for (RTCRayHit& ray : rays) rtcIntersect1(scene, &ray, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1M(scene, &context, rays.data(), static_cast<unsigned>(rays.size()),
                 sizeof(RTCRayHit));
#endif
}

/// Makes tfar negative in each ray that meets something. Thread-safe.
inline void occluded(RTCScene scene, std::span<RTCRay> rays) {
#if RTC_VERSION_MAJOR >= 4
  for (RTCRay& ray : rays) rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1M(scene, &context, rays.data(), static_cast<unsigned>(rays.size()), sizeof(RTCRay));
#endif
}

}  // namespace canopeer::embree
