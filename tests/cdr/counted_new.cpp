#include "counted_new.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> g_largest{0};

}  // namespace

void* operator new(std::size_t size) {
  std::size_t largest = g_largest;
  while (size > largest && !g_largest.compare_exchange_weak(largest, size)) {
  }
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace canopeer {

std::size_t largest_allocation() { return g_largest; }
void forget_allocations() { g_largest = 0; }

}  // namespace canopeer
