// The map's kernels beside OctoMap doing the same job in the same program, on one thread: the rows
// of map_fuse_bench.cpp, map_view_bench.cpp and map_field_bench.cpp.

#include "bench_rows.h"
#include "bench_threads.h"
#include "map_world.h"

int main(int argc, char** argv) {
  { const canopeer::Threads one(1); }  // and one thread it stays
  canopeer::fused_map();               // the scene is made before anything is timed
  canopeer::fused_octree();
  const auto row = [](const char* name, const char* ours, const char* baseline, const char* unit) {
    canopeer::BenchRow r;
    r.name = name;
    r.ours = ours;
    r.baseline = baseline;
    r.unit = unit;
    return r;
  };
  const auto counter = [&](const char* name, const char* ours, const char* baseline,
                           const char* unit, const char* which) {
    canopeer::BenchRow r = row(name, ours, baseline, unit);
    r.counter = which;
    return r;
  };
  canopeer::BenchRow update_all = row("map.update_all", "update_all", "", "ms");
  update_all.stated = 33.0;  // a frame of a 30 Hz camera
  return canopeer::run_benchmarks(
      argc, argv,
      {row("map.fuse_projective", "fuse_new", "octomap_fuse", "ms"),
       row("map.fuse_projective_scalar", "fuse_new_scalar", "octomap_fuse", "ms"),
       row("map.fuse_projective_2_threads", "fuse_new_two_threads", "fuse_new_by_the_clock", "ms"),
       row("map.fuse_projective_again", "fuse_again", "octomap_fuse", "ms"),
       row("map.fuse_projective_5mm", "fuse_new_5mm", "octomap_fuse_5mm", "ms"),
       row("map.fuse_exact_5mm", "fuse_exact_new_5mm", "octomap_fuse_5mm", "ms"),
       row("map.fuse_exact", "fuse_exact_new", "octomap_fuse", "ms"),
       update_all,
       row("map.view_63", "view_cast/63", "octomap_view_cast/63", "us"),
       row("map.view_192", "view_cast/192", "octomap_view_cast/192", "us"),
       row("map.view_1200", "view_cast/1200", "octomap_view_cast/1200", "us"),
       row("map.view_63_three_sets", "view_cast/63", "octomap_view_cast_all/63", "us"),
       row("map.view_1200_three_sets", "view_cast/1200", "octomap_view_cast_all/1200", "us"),
       row("map.view_63_all", "view_cast_all/63", "octomap_view_cast_all/63", "us"),
       row("map.view_1200_all", "view_cast_all/1200", "octomap_view_cast_all/1200", "us"),
       row("map.union_10", "view_union/63", "octomap_view_union/63", "us"),
       row("map.union_10_1200", "view_union/1200", "octomap_view_union/1200", "us"),
       row("map.frontiers", "frontiers", "octomap_frontiers", "us"),
       counter("map.memory", "memory", "octomap_memory", "MB", "MB"),
       counter("map.row_50m_frame_time_growth", "row_50m", "", "x", "growth"),
       counter("map.row_50m_memory", "row_50m", "", "MB", "MB"),
       counter("map.row_50m_snapshot", "row_50m", "", "us", "snapshot_us")});
}
