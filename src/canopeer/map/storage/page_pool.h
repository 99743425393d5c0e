#pragma once

#include <cstddef>
#include <mutex>

namespace canopeer {

/// Memory for the pages of paged arrays, all of one size. They are cut from slabs of 2 MB that the
/// system is asked to back with huge pages. Maps are read and written block by block, here and
/// there: with pages of 4 KB each costs a fault at first, and a walk through the page tables ever
/// after. A slab goes back to the system when its last page does, but for 16 that are kept.
/// Thread-safe.
class PagePool {
 public:
  /// `page_bytes`: at most half a slab; pages are aligned to 64 bytes.
  explicit PagePool(std::size_t page_bytes);
  PagePool(const PagePool&) = delete;
  PagePool& operator=(const PagePool&) = delete;

  /// Throws std::bad_alloc when there is no memory left.
  [[nodiscard]] void* take();
  void give_back(void* page) noexcept;

 private:
  struct Slab;
  struct FreePage;

  [[nodiscard]] Slab* add_slab() const;
  void link(Slab* slab) noexcept;
  void unlink(Slab* slab) noexcept;

  std::mutex mutex_;
  std::size_t page_bytes_;
  Slab* with_room_ = nullptr;  // a list of the slabs that have some
  std::size_t empty_slabs_ = 0;
};

}  // namespace canopeer
