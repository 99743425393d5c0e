#include <gtest/gtest.h>

#include "all_messages.h"
#include "big_endian_writer.h"
#include "random_message.h"

namespace canopeer::ros {
namespace {

constexpr int kRounds = 20;

/// `check(message, payload)` with random messages of every type.
template <class Check>
void with_random_messages(std::uint64_t seed, Check check) {
  for (int round = 0; round < kRounds; ++round) {
    Rng rng(seed, static_cast<std::uint64_t>(round));
    for_each_message([&](const auto& empty) {
      using Message = std::decay_t<decltype(empty)>;
      const auto message = random_message<Message>(rng);
      SCOPED_TRACE(::testing::Message() << "round " << round << ", " << typeid(Message).name());
      check(message, to_cdr(message));
    });
  }
}

TEST(CdrRandom, ReadsBackWhatItWrote) {
  with_random_messages(1, [](const auto& message, const Payload& payload) {
    const auto read = from_cdr<std::decay_t<decltype(message)>>(payload);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_cdr(*read), payload);
  });
}

TEST(CdrRandom, ReadsTheOtherByteOrder) {
  with_random_messages(2, [](const auto& message, const Payload& payload) {
    BigEndianWriter writer;
    writer(message);
    const auto read = from_cdr<std::decay_t<decltype(message)>>(writer.take());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_cdr(*read), payload);
  });
}

TEST(CdrRandom, LeavesWhatComesBehindAlone) {
  with_random_messages(3, [](const auto& message, Payload payload) {
    const Payload exact = payload;
    payload.insert(payload.end(), 8, 0xA5);
    const auto read = from_cdr<std::decay_t<decltype(message)>>(payload);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(to_cdr(*read), exact);
  });
}

TEST(CdrRandom, EveryCutIsAnError) {
  with_random_messages(4, [](const auto& message, const Payload& payload) {
    using Message = std::decay_t<decltype(message)>;
    CdrReader reader(payload);
    Message whole;
    reader(whole);
    const std::size_t needed = payload.size() - reader.left();
    for (std::size_t size = 0; size < needed; ++size) {
      ASSERT_FALSE(from_cdr<Message>(std::span(payload).first(size))) << size << " octets";
    }
    EXPECT_TRUE(from_cdr<Message>(std::span(payload).first(needed)));
  });
}

}  // namespace
}  // namespace canopeer::ros
