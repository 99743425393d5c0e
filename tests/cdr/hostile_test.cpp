#include <gtest/gtest.h>

#include "all_messages.h"
#include "canopeer/cdr/cdr.h"
#include "counted_new.h"
#include "random_message.h"

namespace canopeer::ros {
namespace {

/// Reading takes no more than the payload could hold, whatever it says.
template <class Message>
void expect_bounded(const Payload& payload) {
  forget_allocations();
  (void)from_cdr<Message>(payload);
  EXPECT_LE(largest_allocation(), 16 * payload.size() + 1024);
}

TEST(CdrHostile, CountsThatLieTakeNoMemory) {
  Rng rng(1);
  for_each_message([&](const auto& empty) {
    using Message = std::decay_t<decltype(empty)>;
    SCOPED_TRACE(typeid(Message).name());
    const Payload payload = to_cdr(random_message<Message>(rng));
    for (const std::uint32_t lie : {0xFFFFFFFFu, 0x7FFFFFFFu, 0x01000000u}) {
      for (std::size_t at = 4; at + 4 <= payload.size(); at += 4) {
        Payload changed = payload;
        std::memcpy(changed.data() + at, &lie, 4);
        expect_bounded<Message>(changed);
      }
    }
  });
}

TEST(CdrHostile, ManyThingsOfNoSizeTakeNoMoreThanTheirPayload) {
  Payload payload(1 << 20, 0);
  payload[1] = 1;
  for_each_message([&](const auto& empty) {
    using Message = std::decay_t<decltype(empty)>;
    SCOPED_TRACE(typeid(Message).name());
    for (const std::uint32_t count : {10'000u, 300'000u, 1'000'000u}) {
      for (const std::size_t at : {4u, 8u, 12u, 16u, 20u, 24u}) {
        Payload changed = payload;
        std::memcpy(changed.data() + at, &count, 4);
        expect_bounded<Message>(changed);
      }
    }
  });
}

TEST(CdrHostile, AnyBytesAreAMessageOrAnError) {
  for (int round = 0; round < 300; ++round) {
    Rng rng(2, static_cast<std::uint64_t>(round));
    Payload payload(4 + rng.index(200));
    for (auto& octet : payload) {
      octet = rng.chance(0.6) ? std::uint8_t{0} : static_cast<std::uint8_t>(rng.index(16));
    }
    payload[0] = 0;
    payload[1] = static_cast<std::uint8_t>(rng.index(2));
    for_each_message(
        [&](const auto& empty) { expect_bounded<std::decay_t<decltype(empty)>>(payload); });
  }
}

}  // namespace
}  // namespace canopeer::ros
