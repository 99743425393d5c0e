#include "canopeer/map/storage/huge_memory.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>
#include <utility>

namespace canopeer {

// A huge page more than asked for, so that a multiple of its size lies in it; the rest goes back.
HugeMemory::HugeMemory(std::size_t bytes)
    : bytes_((bytes + kPageBytes - 1) / kPageBytes * kPageBytes) {
  if (bytes_ == 0) return;
  const std::size_t mapped = bytes_ + kPageBytes;
  void* memory =
      ::mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto* start = static_cast<std::byte*>(memory);
  const std::size_t before = (~reinterpret_cast<std::uintptr_t>(start) + 1) % kPageBytes;
  data_ = start + before;
  if (before != 0) ::munmap(start, before);
  ::munmap(data_ + bytes_, mapped - before - bytes_);
  ::madvise(data_, bytes_, MADV_HUGEPAGE);  // a wish: where it is not granted, all is just slower
}

HugeMemory::HugeMemory(HugeMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

HugeMemory& HugeMemory::operator=(HugeMemory&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

HugeMemory::~HugeMemory() {
  if (data_ != nullptr) ::munmap(data_, bytes_);
}

}  // namespace canopeer
