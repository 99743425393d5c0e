#include "canopeer/bounds/view_pool_file.h"

#include <algorithm>
#include <functional>

#include "canopeer/geometry/packed_file.h"
#include "canopeer/geometry/state_archive.h"

namespace canopeer {
namespace {

constexpr PackedKind kPoolKind{"CANOPEER-VIEWS 1\n", "pool of views"};

/// What whoever works with a pool takes for granted.
Expected<void> check_contents(const ViewPool& pool) {
  const std::size_t count = pool.patches.fruit.size();
  if (pool.patches.area_cm2.size() != count || pool.times_seen.size() != count) {
    return fail("damaged: not one area and count for each patch");
  }
  for (const int fruit : pool.patches.fruit) {
    if (fruit < 0 || fruit > 100000000) return fail("damaged: a patch of no fruit");
  }
  for (const auto& views : pool.segments) {
    for (const PoolView& view : views) {
      const auto& seen = view.patches;
      if (std::adjacent_find(seen.begin(), seen.end(), std::greater_equal<>()) != seen.end() ||
          (!seen.empty() && seen.back() >= count)) {
        return fail("damaged: a view of patches that are not there");
      }
    }
  }
  return {};
}

}  // namespace

Expected<void> write_view_pool(const std::filesystem::path& path, const ViewPool& pool) {
  return write_packed(path, kPoolKind, state_bytes(pool));
}

Expected<ViewPool> read_view_pool(const std::filesystem::path& path) {
  const auto bytes = read_packed(path, kPoolKind);
  if (!bytes) return tl::unexpected(bytes.error());
  ViewPool pool;
  if (auto ok = read_state_bytes(*bytes, pool); !ok) return fail_in(path.string(), ok.error());
  if (auto ok = check_contents(pool); !ok) return fail_in(path.string(), ok.error());
  return pool;
}

}  // namespace canopeer
