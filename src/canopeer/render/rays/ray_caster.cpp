#include "canopeer/render/rays/ray_caster.h"

#include <oneapi/tbb/task_arena.h>

#include <array>
#include <cstring>

#include "canopeer/base/check.h"
#include "canopeer/render/rays/embree.h"

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

constexpr float kForEver = std::numeric_limits<float>::infinity();

RTCRay embree_ray(const RayCaster::Ray& ray, float from, float to = kForEver) {
  RTCRay r;
  r.org_x = ray.origin.x();
  r.org_y = ray.origin.y();
  r.org_z = ray.origin.z();
  r.tnear = from;
  r.dir_x = ray.direction.x();
  r.dir_y = ray.direction.y();
  r.dir_z = ray.direction.z();
  r.time = 0.0F;
  r.tfar = to;
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
  /// One tree: the world's, or a model's.
  struct Tree {
    RTCScene scene = nullptr;
    std::array<std::uint32_t, 2> first_triangle{};  // of each geometry
  };

  RTCDevice device = nullptr;
  Tree world;
  std::vector<Tree> models;
  std::vector<std::size_t> model_of;  // per instance
  std::uint32_t first_instance = 0;   // geometry in the world's tree

  [[nodiscard]] Tree new_tree(const SurfaceSoup& soup) const;
  void attach(const SurfaceSoup& soup, std::uint32_t begin, std::uint32_t end, Tree* tree) const;
  void attach(const Placement& placement);
  void commit(const Tree& tree) const;
  [[nodiscard]] Hit hit_of(const RTCRayHit& r) const;
  void occluded(std::span<const Ray> rays, float from, float to, std::span<bool> blocked) const;
};

/// Triangles begin … end as a geometry of their own.
void RayCaster::Impl::attach(const SurfaceSoup& soup, std::uint32_t begin, std::uint32_t end,
                             Tree* tree) const {
  if (begin == end) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // The fourth word of each, its part, is passed over.
  const std::vector<SurfaceSoup::Triangle> triangles(soup.triangles.begin() + begin,
                                                     soup.triangles.begin() + end);
  copy_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, soup.vertices);
  copy_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  if (begin >= soup.first_cut) {
    rtcSetGeometryUserData(geometry, const_cast<SurfaceSoup*>(&soup));
    rtcSetGeometryIntersectFilterFunction(geometry, let_through_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, let_through_holes);
  }
  rtcCommitGeometry(geometry);
  tree->first_triangle[rtcAttachGeometry(tree->scene, geometry)] = begin;
  rtcReleaseGeometry(geometry);
}

RayCaster::Impl::Tree RayCaster::Impl::new_tree(const SurfaceSoup& soup) const {
  Tree tree;
  tree.scene = rtcNewScene(device);
  // No gaps between neighbouring triangles.
  rtcSetSceneFlags(tree.scene, RTC_SCENE_FLAG_ROBUST);
  attach(soup, 0, soup.first_cut, &tree);
  attach(soup, soup.first_cut, static_cast<std::uint32_t>(soup.triangles.size()), &tree);
  return tree;
}

void RayCaster::Impl::attach(const Placement& placement) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, models[placement.model].scene);
  const Eigen::Matrix<float, 3, 4> T =
      placement.T_world_model.matrix().topRows<3>().cast<float>();  // column by column
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, T.data());
  rtcCommitGeometry(geometry);
  const std::uint32_t id = rtcAttachGeometry(world.scene, geometry);
  if (model_of.empty()) first_instance = id;
  CANOPEER_CHECK(id == first_instance + model_of.size(), "Embree numbers geometries in order");
  model_of.push_back(placement.model);
  rtcReleaseGeometry(geometry);
}

/// One thread builds: the tree, and with it which of two triangles is hit on their common edge, is
/// the same every time.
void RayCaster::Impl::commit(const Tree& tree) const {
  oneapi::tbb::task_arena(1).execute([&] { rtcJoinCommitScene(tree.scene); });
  CANOPEER_CHECK(rtcGetDeviceError(device) == RTC_ERROR_NONE, "Embree cannot build");
}

RayCaster::Hit RayCaster::Impl::hit_of(const RTCRayHit& r) const {
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const bool copy = r.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const std::uint32_t instance = copy ? r.hit.instID[0] - first_instance : Hit::kNone;
  const Tree& tree = copy ? models[model_of[instance]] : world;
  return {tree.first_triangle[r.hit.geomID] + r.hit.primID, instance, r.ray.tfar, r.hit.u, r.hit.v};
}

RayCaster::RayCaster(const SurfaceSoup& world, const std::vector<SurfaceSoup>& models,
                     const std::vector<Placement>& instances)
    : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(kDeviceConfig);
  CANOPEER_CHECK(impl_->device != nullptr, "Embree needs SSE 4.2");
  for (const SurfaceSoup& model : models) {
    impl_->models.push_back(impl_->new_tree(model));
    impl_->commit(impl_->models.back());
  }
  impl_->world = impl_->new_tree(world);
  for (const Placement& placement : instances) impl_->attach(placement);
  impl_->commit(impl_->world);
}

RayCaster::~RayCaster() {
  rtcReleaseScene(impl_->world.scene);
  for (const Impl::Tree& model : impl_->models) rtcReleaseScene(model.scene);
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
  embree::closest_of_neighbors(impl_->world.scene, {packet.data(), rays.size()});
  for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = impl_->hit_of(packet[i]);
}

void RayCaster::Impl::occluded(std::span<const Ray> rays, float from, float to,
                               std::span<bool> blocked) const {
  CANOPEER_CHECK(rays.size() <= kPacket && blocked.size() == rays.size(), "a packet of rays");
  std::array<RTCRay, kPacket> packet;
  for (std::size_t i = 0; i < rays.size(); ++i) packet[i] = embree_ray(rays[i], from, to);
  embree::occluded(world.scene, {packet.data(), rays.size()});
  for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = packet[i].tfar < 0.0F;
}

void RayCaster::occluded(std::span<const Ray> rays, float from, std::span<bool> blocked) const {
  impl_->occluded(rays, from, kForEver, blocked);
}

void RayCaster::blocked_between(std::span<const Ray> rays, std::span<bool> blocked) const {
  impl_->occluded(rays, 0.0F, 1.0F, blocked);
}

}  // namespace canopeer
