#pragma once

#include <cstddef>

namespace canopeer {

/// Memory that the system is asked to back with huge pages. For what is read and written here and
/// there all over: it costs far fewer faults at first, and fewer walks through page tables later
/// on. Zeros.
class HugeMemory {
 public:
  /// A huge page of x86-64; the memory starts at a multiple of it.
  static constexpr std::size_t kPageBytes = std::size_t{1} << 21;

  HugeMemory() = default;
  /// `bytes` are rounded up to whole huge pages. Throws std::bad_alloc when there is no memory
  /// left.
  explicit HugeMemory(std::size_t bytes);
  HugeMemory(HugeMemory&& other) noexcept;
  HugeMemory& operator=(HugeMemory&& other) noexcept;
  ~HugeMemory();

  [[nodiscard]] std::byte* data() const { return data_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace canopeer
