#include "canopeer/render/raster/rasterizer.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "canopeer/base/check.h"
#include "canopeer/render/raster/raster_kernels.h"
#include "canopeer/render/surfaces/surface_plane.h"

namespace canopeer {
namespace {

static_assert(TriangleClusters::kPadding % kRasterLanes == 0);

int threads_at_work() {
  const auto allowed = static_cast<int>(oneapi::tbb::global_control::active_value(
      oneapi::tbb::global_control::max_allowed_parallelism));
  return std::max(1, std::min(allowed, oneapi::tbb::this_task_arena::max_concurrency()));
}

/// All that drawing one view shares.
struct DrawnView {
  const std::vector<RasterBody>& bodies;
  const std::vector<BodyView>& places;
  const std::vector<QueuedCluster>& queue;
  const CameraIntrinsics& camera;
  const Pose& T_world_camera;
  const std::vector<float>& column_centre;
  const RasterKernels& kernels;
};

/// A group whose texture has holes, for the kernel's questions.
struct CutCluster {
  const SurfaceSoup& soup;
  const std::uint32_t* triangles;
  BodyRays rays;
  const CameraIntrinsics& camera;

  static bool solid(const void* context, std::size_t triangle, int column, int row) {
    const auto& self = *static_cast<const CutCluster*>(context);
    const Vec3 ray = self.camera.ray(column, row);
    const std::uint32_t t = self.triangles[triangle];
    const Vec3 w = SurfacePlane(self.soup, t, self.rays.eye)
                       .weights_inside(self.rays.direction(ray.x(), ray.y()));
    return canopeer::solid(self.soup, t, {static_cast<float>(w.y()), static_cast<float>(w.z())});
  }
};

RasterCluster cluster_of(const DrawnView& view, std::size_t place) {
  const QueuedCluster& queued = view.queue[place];
  const TriangleClusters& all = *view.bodies[queued.body].clusters;
  const TriangleClusters::Cluster& cluster = all.clusters[queued.cluster];
  const BodyView& body = view.places[queued.body];
  RasterCluster raster;
  raster.x = all.x.data() + cluster.first_vertex;
  raster.y = all.y.data() + cluster.first_vertex;
  raster.z = all.z.data() + cluster.first_vertex;
  raster.vertices = cluster.vertices;
  raster.corners = all.corners[cluster.first_triangle].data();
  raster.triangles = cluster.triangles;
  raster.first_surface = static_cast<std::uint32_t>(place * TriangleClusters::kMaxTriangles);
  for (int i = 0; i < 9; ++i) raster.turn[i] = body.turn(i / 3, i % 3);
  for (int i = 0; i < 3; ++i) {
    raster.eye[i] = body.eye[i];
    raster.shift[i] = body.shift[i];
  }
  return raster;
}

bool draw_cut(const DrawnView& view, const QueuedCluster& queued, RasterCluster cluster,
              const RasterWindow& window) {
  const RasterBody& body = view.bodies[queued.body];
  const CutCluster cut{
      *body.soup,
      body.clusters->triangles.data() + body.clusters->clusters[queued.cluster].first_triangle,
      BodyRays(body.T_world_body, view.T_world_camera), view.camera};
  cluster.solid = CutCluster::solid;
  cluster.context = &cut;
  return view.kernels.draw(cluster, window);
}

/// Groups begin … end of the queue, by place.
struct QueuePart {
  std::size_t begin = 0, end = 0;
};

/// Rows first … last of the picture; both at borders of tiles.
void draw_strip(const DrawnView& view, const QueuePart& part, int first_row, int last_row,
                DepthTiles* tiles) {
  RasterWindow window;
  window.last_column = view.camera.width - 1;
  window.first_row = first_row;
  window.last_row = last_row;
  window.cx = view.camera.cx;
  window.cy = view.camera.cy;
  window.column_centre = view.column_centre.data();
  window.nearness = tiles->nearness();
  window.surface = tiles->surface();
  window.stride = tiles->stride();
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const QueuedCluster& queued = view.queue[i];
    PixelBox box = queued.box;
    box.first_row = std::max(box.first_row, first_row);
    box.last_row = std::min(box.last_row, last_row);
    if (box.first_row > box.last_row || tiles->hidden(box, queued.nearness)) continue;
    const RasterCluster cluster = cluster_of(view, i);
    const bool cut = view.bodies[queued.body].clusters->clusters[queued.cluster].cut;
    if (cut ? draw_cut(view, queued, cluster, window) : view.kernels.draw(cluster, window)) {
      tiles->drawn(box);
    }
  }
}

/// Of each column, and some beyond the last: its centre less cx, pixels.
std::vector<float> column_centres(const CameraIntrinsics& camera, std::size_t stride) {
  std::vector<float> centres(stride + kRasterLanes);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    centres[i] = static_cast<float>(static_cast<double>(i) + 0.5 - camera.cx);
  }
  return centres;
}

}  // namespace

std::vector<BodyView> Rasterizer::places_of(const CameraIntrinsics& camera,
                                            const Pose& T_world_camera) const {
  std::vector<BodyView> places;
  places.reserve(bodies_.size());
  for (const RasterBody& body : bodies_) {
    places.push_back(body_view(body, camera, T_world_camera));
  }
  return places;
}

VisibleImage Rasterizer::draw(const CameraIntrinsics& camera, const Pose& T_world_camera) const {
  VisibleImage image(camera.width, camera.height);
  image.bodies_ = &bodies_;
  const std::vector<BodyView> places = places_of(camera, T_world_camera);
  image.queue_ = queue_clusters(bodies_, places, camera);
  CANOPEER_CHECK(image.queue_.size() < kNoSurface / VisibleImage::kPerCluster,
                 "surfaces have 32 bit numbers");
  const std::vector<float> column_centre = column_centres(camera, image.tiles_.stride());
  const DrawnView view{bodies_,        places,        image.queue_,          camera,
                       T_world_camera, column_centre, raster_kernels(level_)};
  // A pixel's surface does not depend on how the picture is shared out; groups on a border are
  // prepared twice.
  const int rows_of_tiles = (camera.height + DepthTiles::kTile - 1) / DepthTiles::kTile;
  const int threads = threads_at_work();
  const int strips = threads == 1 ? 1 : std::min(rows_of_tiles, 2 * threads);
  oneapi::tbb::parallel_for(0, strips, [&](int strip) {
    const int begin = rows_of_tiles * strip / strips * DepthTiles::kTile;
    const int end = rows_of_tiles * (strip + 1) / strips * DepthTiles::kTile;
    draw_strip(view, {0, image.queue_.size()}, begin, std::min(end, camera.height) - 1,
               &image.tiles_);
  });
  return image;
}

VisibleImage Rasterizer::draw_first_body(const CameraIntrinsics& camera, const Pose& T_world_camera,
                                         float far_m) const {
  VisibleImage image(camera.width, camera.height);
  image.bodies_ = &bodies_;
  const std::vector<BodyView> places = places_of(camera, T_world_camera);
  const auto first_other = bodies_.begin() + 1;
  image.queue_ = queue_clusters({bodies_.begin(), first_other}, {places.front()}, camera, far_m);
  const std::size_t own = image.queue_.size();
  for (QueuedCluster cluster : queue_clusters({first_other, bodies_.end()},
                                              {places.begin() + 1, places.end()}, camera, far_m)) {
    ++cluster.body;
    image.queue_.push_back(cluster);
  }
  CANOPEER_CHECK(image.queue_.size() < kNoSurface / VisibleImage::kPerCluster,
                 "surfaces have 32 bit numbers");
  const std::vector<float> column_centre = column_centres(camera, image.tiles_.stride());
  const DrawnView view{bodies_,        places,        image.queue_,          camera,
                       T_world_camera, column_centre, raster_kernels(level_)};
  draw_strip(view, {0, own}, 0, camera.height - 1, &image.tiles_);
  image.tiles_.close_empty();
  draw_strip(view, {own, image.queue_.size()}, 0, camera.height - 1, &image.tiles_);
  return image;
}

void VisibleImage::row(int v, std::vector<VisibleRun>* runs) const {
  runs->clear();
  const std::uint32_t* surface = tiles_.surface_row(v);
  const auto width = static_cast<std::uint32_t>(width_);
  for (std::uint32_t begin = 0, end = 0; begin < width; begin = end) {
    const std::uint32_t here = surface[begin];
    while (end < width && surface[end] == here) ++end;
    VisibleRun run{begin, end, {}};
    if (here != kNoSurface) {
      const QueuedCluster& queued = queue_[here / kPerCluster];
      const TriangleClusters& all = *(*bodies_)[queued.body].clusters;
      const std::uint32_t first = all.clusters[queued.cluster].first_triangle;
      run.surface = {queued.body, all.triangles[first + here % kPerCluster]};
    }
    runs->push_back(run);
  }
}

}  // namespace canopeer
