#include "canopeer/dds/delivery.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <vector>

namespace canopeer::ros {
namespace {

constexpr std::size_t kMany = 1000;
constexpr std::size_t kRoomy = 1 << 20;

/// Holds up the thread until it goes.
class Stopper {
 public:
  explicit Stopper(Delivery& delivery) : lane_(delivery, kMany, kRoomy) {
    std::promise<void> begun;
    lane_.put(0, [&begun, go = go_.get_future().share()] {
      begun.set_value();
      go.wait();
    });
    begun.get_future().wait();
  }
  ~Stopper() { go_.set_value(); }

 private:
  std::promise<void> go_;
  Delivery::Lane lane_;
};

void wait_for_all(Delivery& delivery) {
  Delivery::Lane lane(delivery, 1, 0);
  std::promise<void> told;
  lane.put(0, [&] { told.set_value(); });
  told.get_future().wait();
}

TEST(Delivery, TellsAllLanesInTheOrderOfArrival) {
  Delivery delivery;
  std::vector<int> told;
  Delivery::Lane a(delivery, kMany, kRoomy);
  Delivery::Lane b(delivery, kMany, kRoomy);
  for (int i = 0; i < 100; ++i) (i % 3 == 0 ? a : b).put(8, [&told, i] { told.push_back(i); });
  wait_for_all(delivery);
  ASSERT_EQ(told.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(told[static_cast<std::size_t>(i)], i);
}

TEST(Delivery, KeepsTheLastThatWait) {
  Delivery delivery;
  std::vector<int> told;
  Delivery::Lane few(delivery, 3, kRoomy);
  Delivery::Lane other(delivery, kMany, kRoomy);
  {
    const Stopper stopper(delivery);
    other.put(8, [&] { told.push_back(-1); });
    for (int i = 0; i < 10; ++i) few.put(8, [&told, i] { told.push_back(i); });
  }
  wait_for_all(delivery);
  EXPECT_EQ(told, (std::vector<int>{-1, 7, 8, 9}));
}

TEST(Delivery, KeepsNoMoreOctetsThanAllowedButOneAlways) {
  Delivery delivery;
  std::vector<int> told;
  Delivery::Lane narrow(delivery, kMany, 100);
  const auto put = [&](int i, std::size_t octets) {
    narrow.put(octets, [&told, i] { told.push_back(i); });
  };
  {
    const Stopper stopper(delivery);
    for (int i = 0; i < 5; ++i) put(i, 40);
  }
  wait_for_all(delivery);
  EXPECT_EQ(told, (std::vector<int>{3, 4}));
  told.clear();
  {
    const Stopper stopper(delivery);
    put(0, 40);
    put(1, 1000);
  }
  wait_for_all(delivery);
  EXPECT_EQ(told, std::vector<int>{1});
}

TEST(Delivery, OfAClosedLaneNothingIsTold) {
  Delivery delivery;
  std::atomic<int> told{0};
  Delivery::Lane lane(delivery, kMany, kRoomy);
  {
    const Stopper stopper(delivery);
    lane.put(8, [&] { ++told; });
    lane.close();
    lane.put(8, [&] { ++told; });
  }
  wait_for_all(delivery);
  EXPECT_EQ(told, 0);
}

TEST(Delivery, ClosingWaitsForWhatIsBeingTold) {
  Delivery delivery;
  std::atomic<bool> over{false};
  Delivery::Lane lane(delivery, kMany, kRoomy);
  std::promise<void> begun;
  lane.put(8, [&] {
    begun.set_value();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    over = true;
  });
  begun.get_future().wait();
  lane.close();
  EXPECT_TRUE(over);
}

TEST(Delivery, ALaneMayGoWhileAnotherIsTold) {
  Delivery delivery;
  auto gone = std::make_unique<Delivery::Lane>(delivery, kMany, kRoomy);
  Delivery::Lane lane(delivery, kMany, kRoomy);
  lane.put(8, [&] { gone.reset(); });
  wait_for_all(delivery);
  EXPECT_EQ(gone, nullptr);
}

}  // namespace
}  // namespace canopeer::ros
