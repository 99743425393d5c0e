#pragma once

#include <utility>

namespace canopeer {

/// A value whose memory the thread keeps for the next one of its type. Frames need buffers of a
/// megabyte; to hand them back to the system and have them cleared anew costs a millisecond a
/// frame. What the last one left is still in it. While one is in use, another of the type starts
/// with nothing (in a task that the thread takes up while it waits for others).
template <typename T>
class Kept {
 public:
  Kept() : value_(std::move(last())) {}
  ~Kept() { last() = std::move(value_); }
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;

  T& operator*() { return value_; }
  T* operator->() { return &value_; }

 private:
  static T& last() {
    static thread_local T value;
    return value;
  }

  T value_;
};

}  // namespace canopeer
