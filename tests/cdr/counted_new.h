#pragma once

#include <cstddef>

namespace canopeer {

/// In this test program every `new` is looked at: the octets of the largest one since
/// forget_allocations().
std::size_t largest_allocation();
void forget_allocations();

}  // namespace canopeer
