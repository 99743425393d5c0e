#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace canopeer::ros {

/// Calls what readers and writers of a participant have to tell, in one thread of its own and in
/// the order in which it came. The DDS library's threads hold its locks while they tell something:
/// whoever listens there for long stops discovery, and Fast DDS 3.1 for good (decision 127).
class Delivery {
 public:
  /// One reader's or writer's part. Closes when it goes.
  class Lane {
   public:
    /// Keeps the last `most` that wait, fewer if they have more than `most_octets` (but one
    /// always).
    Lane(Delivery& delivery, std::size_t most, std::size_t most_octets);
    ~Lane();
    Lane(const Lane&) = delete;
    Lane& operator=(const Lane&) = delete;
    /// Calls `tell` soon, unless it is closed first. Thread-safe.
    void put(std::size_t octets, std::function<void()> tell);
    /// Waits for what is being told; tells nothing afterwards. Not from within `tell`.
    void close();

   private:
    friend class Delivery;
    Delivery& delivery_;
    const std::size_t most_;
    const std::size_t most_octets_;
    std::size_t waiting_ = 0;
    std::size_t octets_ = 0;
    bool closed_ = false;
  };

  Delivery();
  /// Lanes go first.
  ~Delivery();

 private:
  struct Item {
    Lane* lane = nullptr;
    std::size_t octets = 0;
    std::function<void()> tell;
  };
  void live(const std::stop_token& stop);
  void drop(std::deque<Item>::iterator item);

  std::mutex mutex_;  ///< of all that follows and of lanes; never held while something is told
  std::condition_variable_any more_;
  std::condition_variable told_;
  std::deque<Item> waiting_;
  const Lane* telling_ = nullptr;
  std::jthread thread_;
};

}  // namespace canopeer::ros
