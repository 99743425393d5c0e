#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "canopeer/map/storage/page_pool.h"

namespace canopeer {

/// An array in pages that its copies share. A copy costs a pointer a page. Whoever writes to a page
/// that others hold too gets a page of its own first. Growing moves no item. Copies may be used
/// from different threads; one array is written from one thread at a time, but for owned().
template <typename T, std::size_t kPageItems>
class PagedArray {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const T& operator[](std::size_t i) const {
    return pages_[i / kPageItems]->items[i % kPageItems];
  }
  /// The item to be written. References from before to items of its page go stale when a copy
  /// shares the page.
  T& own(std::size_t i) { return pages_[i / kPageItems].own().items[i % kPageItems]; }
  /// The same for an item that own() was called for since the last copy was taken. Different items
  /// may be written at the same time.
  T& owned(std::size_t i) { return pages_[i / kPageItems]->items[i % kPageItems]; }
  /// The new item's place.
  std::size_t push_back(const T& item) {
    const std::size_t i = add();
    own(i) = item;
    return i;
  }
  /// The same for an item yet to be written.
  std::size_t add() {
    if (size_ == pages_.size() * kPageItems) pages_.emplace_back();
    return size_++;
  }
  void resize(std::size_t size, const T& item) {
    while (size_ < size) push_back(item);
  }
  [[nodiscard]] std::size_t memory_bytes() const {
    return pages_.size() * sizeof(Page) + pages_.capacity() * sizeof(Handle);
  }

 private:
  struct Page {
    std::atomic<std::uint32_t> owners{1};
    std::array<T, kPageItems> items;

    static void* operator new(std::size_t) { return pool().take(); }
    static void operator delete(void* page) { pool().give_back(page); }
    // Never destroyed: arrays of static storage duration may be the last to go.
    static PagePool& pool() {
      static PagePool& pages = *new PagePool(sizeof(Page));
      return pages;
    }
  };

  class Handle {
   public:
    Handle() : page_(new Page) {}
    Handle(const Handle& other) : page_(other.page_) {
      page_->owners.fetch_add(1, std::memory_order_relaxed);
    }
    Handle(Handle&& other) noexcept : page_(std::exchange(other.page_, nullptr)) {}
    Handle& operator=(Handle other) noexcept {
      std::swap(page_, other.page_);
      return *this;
    }
    ~Handle() {
      if (page_ != nullptr && page_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) {
        delete page_;
      }
    }
    Page* operator->() const { return page_; }
    // Acquire: what another owner read, it read before it let go of the page.
    Page& own() {
      if (page_->owners.load(std::memory_order_acquire) != 1) {
        Handle copy;
        copy.page_->items = page_->items;
        std::swap(page_, copy.page_);
      }
      return *page_;
    }

   private:
    Page* page_;
  };

  std::vector<Handle> pages_;
  std::size_t size_ = 0;
};

}  // namespace canopeer
