#pragma once

namespace canopeer::ros {

/// Several functions as one, for std::visit.
template <class... Functions>
struct Visitors : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Visitors(Functions...) -> Visitors<Functions...>;

}  // namespace canopeer::ros
