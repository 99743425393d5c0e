#include "canopeer/map/storage/page_pool.h"

#include <cstdint>
#include <new>
#include <utility>

#include "canopeer/base/check.h"
#include "canopeer/map/storage/huge_memory.h"

namespace canopeer {
namespace {

constexpr std::size_t kSlabBytes = HugeMemory::kPageBytes;
constexpr std::size_t kAlignment = 64;
// Slabs without a page in use that wait for the next map: taking new ones means clearing them.
constexpr std::size_t kEmptySlabs = 16;

constexpr std::size_t round_up(std::size_t bytes) {
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

}  // namespace

struct PagePool::FreePage {
  FreePage* next;
};

// At the start of each slab, which is aligned to its size: so a page finds its slab.
struct PagePool::Slab {
  HugeMemory memory;  // that it lies in itself
  Slab* next = nullptr;
  Slab* previous = nullptr;
  FreePage* given_back = nullptr;
  std::size_t used = 0;   // pages that somebody holds
  std::size_t begun = 0;  // pages that were ever handed out: the rest was never touched
};

PagePool::PagePool(std::size_t page_bytes) : page_bytes_(round_up(page_bytes)) {
  CANOPEER_CHECK(2 * page_bytes_ + round_up(sizeof(Slab)) <= kSlabBytes, "the pages are too large");
}

PagePool::Slab* PagePool::add_slab() const {
  HugeMemory memory(kSlabBytes);
  void* start = memory.data();
  return new (start) Slab{std::move(memory)};
}

void PagePool::link(Slab* slab) noexcept {
  slab->previous = nullptr;
  slab->next = with_room_;
  if (with_room_ != nullptr) with_room_->previous = slab;
  with_room_ = slab;
}

void PagePool::unlink(Slab* slab) noexcept {
  (slab->previous != nullptr ? slab->previous->next : with_room_) = slab->next;
  if (slab->next != nullptr) slab->next->previous = slab->previous;
}

void* PagePool::take() {
  const std::lock_guard lock(mutex_);
  if (with_room_ == nullptr) {
    link(add_slab());
    ++empty_slabs_;
  }
  Slab* slab = with_room_;
  if (slab->used++ == 0) --empty_slabs_;
  const std::size_t first = round_up(sizeof(Slab));
  const std::size_t pages = (kSlabBytes - first) / page_bytes_;
  void* page = slab->given_back;
  if (page != nullptr) {
    slab->given_back = slab->given_back->next;
  } else {
    page = reinterpret_cast<char*>(slab) + first + slab->begun++ * page_bytes_;
  }
  if (slab->used == pages) unlink(slab);
  return page;
}

void PagePool::give_back(void* page) noexcept {
  const auto address = reinterpret_cast<std::uintptr_t>(page);
  auto* slab = reinterpret_cast<Slab*>(address & ~(kSlabBytes - 1));
  const std::lock_guard lock(mutex_);
  const std::size_t pages = (kSlabBytes - round_up(sizeof(Slab))) / page_bytes_;
  if (slab->used == pages) link(slab);
  slab->given_back = new (page) FreePage{slab->given_back};
  --slab->used;
  if (slab->used != 0) return;
  if (empty_slabs_ < kEmptySlabs) {
    ++empty_slabs_;
    return;
  }
  unlink(slab);
  const HugeMemory freed = std::move(slab->memory);
}

}  // namespace canopeer
