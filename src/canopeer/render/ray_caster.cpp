#include "canopeer/render/ray_caster.h"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

#include <array>
#include <cstring>

#include "canopeer/base/check.h"

namespace canopeer {
namespace {

// One instruction set for all machines: with AVX2 Embree fuses multiply and add, and depths would
// differ in the last bit from one processor to the next. Every x86-64 of the last 15 years has it.
constexpr const char* kDeviceConfig = "isa=sse4.2";

template <typename T>
void copy_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                 const std::vector<T>& from) {
  // Embree reads up to 16 bytes at a vertex and pads its own buffers for that.
  void* to = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), from.size());
  CANOPEER_CHECK(to != nullptr, "Embree has no memory for the scene");
  std::memcpy(to, from.data(), from.size() * sizeof(T));
}

RTCRay embree_ray(const RayCaster::Ray& ray, float from) {
  RTCRay r;
  r.org_x = ray.origin.x();
  r.org_y = ray.origin.y();
  r.org_z = ray.origin.z();
  r.tnear = from;
  r.dir_x = ray.direction.x();
  r.dir_y = ray.direction.y();
  r.dir_z = ray.direction.z();
  r.time = 0.0F;
  r.tfar = std::numeric_limits<float>::infinity();
  r.mask = ~0U;
  r.id = 0;
  r.flags = 0;
  return r;
}

/// Embree asks for each hit on a triangle with holes whether it counts.
void let_through_holes(const RTCFilterFunctionNArguments* args) {
  const auto& soup = *static_cast<const SurfaceSoup*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const std::uint32_t triangle = soup.first_cut + RTCHitN_primID(args->hit, args->N, i);
    const Barycentric at{RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)};
    if (!solid(soup, triangle, at)) args->valid[i] = 0;
  }
}

}  // namespace

struct RayCaster::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::array<std::uint32_t, 2> first_triangle{};  // of each geometry

  void attach(const SurfaceSoup& soup, std::uint32_t begin, std::uint32_t end);
};

/// Triangles begin … end as a geometry of their own.
void RayCaster::Impl::attach(const SurfaceSoup& soup, std::uint32_t begin, std::uint32_t end) {
  if (begin == end) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::vector<std::array<std::uint32_t, 3>> triangles(soup.triangles.begin() + begin,
                                                            soup.triangles.begin() + end);
  copy_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, soup.vertices);
  copy_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  if (begin >= soup.first_cut) {
    rtcSetGeometryUserData(geometry, const_cast<SurfaceSoup*>(&soup));
    rtcSetGeometryIntersectFilterFunction(geometry, let_through_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, let_through_holes);
  }
  rtcCommitGeometry(geometry);
  first_triangle[rtcAttachGeometry(scene, geometry)] = begin;
  rtcReleaseGeometry(geometry);
}

RayCaster::RayCaster(const SurfaceSoup& soup) : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(kDeviceConfig);
  CANOPEER_CHECK(impl_->device != nullptr, "Embree needs SSE 4.2");
  impl_->scene = rtcNewScene(impl_->device);
  // No gaps between neighbouring triangles.
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  impl_->attach(soup, 0, soup.first_cut);
  impl_->attach(soup, soup.first_cut, static_cast<std::uint32_t>(soup.triangles.size()));
  // One thread builds: the tree, and with it which of two triangles is hit on their common edge,
  // is the same every time.
  oneapi::tbb::task_arena(1).execute([this] { rtcJoinCommitScene(impl_->scene); });
  CANOPEER_CHECK(rtcGetDeviceError(impl_->device) == RTC_ERROR_NONE, "Embree cannot build");
}

RayCaster::~RayCaster() {
  rtcReleaseScene(impl_->scene);
  rtcReleaseDevice(impl_->device);
}

void RayCaster::closest(std::span<const Ray> rays, std::span<Hit> hits) const {
  CANOPEER_CHECK(rays.size() <= kPacket && hits.size() == rays.size(), "a packet of rays");
  std::array<RTCRayHit, kPacket> packet;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    packet[i].ray = embree_ray(rays[i], 0.0F);
    packet[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    packet[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1M(impl_->scene, &context, packet.data(), static_cast<unsigned>(rays.size()),
                 sizeof(RTCRayHit));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RTCHit& hit = packet[i].hit;
    hits[i] =
        hit.geomID != RTC_INVALID_GEOMETRY_ID
            ? Hit{impl_->first_triangle[hit.geomID] + hit.primID, packet[i].ray.tfar, hit.u, hit.v}
            : Hit{};
  }
}

void RayCaster::occluded(std::span<const Ray> rays, float from, std::span<bool> blocked) const {
  CANOPEER_CHECK(rays.size() <= kPacket && blocked.size() == rays.size(), "a packet of rays");
  std::array<RTCRay, kPacket> packet;
  for (std::size_t i = 0; i < rays.size(); ++i) packet[i] = embree_ray(rays[i], from);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1M(impl_->scene, &context, packet.data(), static_cast<unsigned>(rays.size()),
                sizeof(RTCRay));
  for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = packet[i].tfar < 0.0F;
}

}  // namespace canopeer
