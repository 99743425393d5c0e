#include "canopeer/replay/replay_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

namespace fs = std::filesystem;

class ReplayLogTest : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::temp_directory_path() /
            (std::string("canopeer_replay_") +
             ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove(path_);
  }
  void TearDown() override { fs::remove(path_); }

  /// Three pieces of 1, 2 and 3 frames.
  void write() {
    auto log = ReplayLog::create(path_);
    ASSERT_TRUE(log.has_value()) << log.error().message;
    for (int piece = 1; piece <= 3; ++piece) {
      ASSERT_TRUE((*log)->append(frames(piece)).has_value());
      sizes_.push_back(fs::file_size(path_));
    }
  }
  static std::vector<Frame> frames(int count) {
    std::vector<Frame> all;
    for (int i = 0; i < count; ++i) {
      all.push_back({"{\"type\":\"log\",\"n\":" + std::to_string(i) + "}",
                     std::string(static_cast<std::size_t>(100 * count + i), '\0')});
    }
    return all;
  }
  void put(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  }

  fs::path path_;
  std::vector<std::uintmax_t> sizes_;  // after each piece
};

TEST_F(ReplayLogTest, GivesBackWhatWasWrittenAlsoWhileItIsWritten) {
  auto log = ReplayLog::create(path_);
  ASSERT_TRUE(log.has_value());
  int told = 0;
  (*log)->on_append([&] { ++told; });
  ASSERT_TRUE((*log)->append(frames(2)).has_value());
  ASSERT_TRUE((*log)->append({}).has_value());  // nothing: no piece
  EXPECT_EQ(told, 1);
  EXPECT_EQ((*log)->pieces(), 1U);
  EXPECT_EQ((*log)->frames(), 2U);
  const auto piece = (*log)->piece(0);
  ASSERT_TRUE(piece.has_value());
  ASSERT_EQ(piece->size(), 2U);
  EXPECT_EQ((*piece)[1], frames(2)[1].bytes());
  EXPECT_FALSE((*log)->piece(1).has_value());
}

TEST_F(ReplayLogTest, AFileCutAnywhereIsReadUpToItsLastWholePiece) {
  write();
  const auto whole = read_file(path_);
  ASSERT_TRUE(whole.has_value());
  for (std::size_t size = 0; size <= whole->size(); ++size) {
    put(whole->substr(0, size));
    const auto log = ReplayLog::open(path_);
    if (size < sizes_[0]) {
      EXPECT_EQ(log ? (*log)->pieces() : 0U, 0U) << size;
      continue;
    }
    ASSERT_TRUE(log.has_value()) << size;
    const auto pieces = static_cast<std::size_t>(
        std::count_if(sizes_.begin(), sizes_.end(), [&](auto end) { return end <= size; }));
    EXPECT_EQ((*log)->pieces(), pieces) << size;
    EXPECT_EQ((*log)->lost_bytes(), size - sizes_[pieces - 1]) << size;
    for (std::size_t i = 0; i < pieces; ++i) EXPECT_TRUE((*log)->piece(i).has_value());
  }
}

TEST_F(ReplayLogTest, IsReadUpToTheFirstDamage) {
  write();
  const std::string whole = *read_file(path_);
  std::string bytes = whole;
  bytes[sizes_[0] + 20] ^= 1;  // in the second piece's packed octets
  put(bytes);
  auto log = ReplayLog::open(path_);
  ASSERT_TRUE(log.has_value());
  EXPECT_EQ((*log)->pieces(), 1U);
  EXPECT_EQ((*log)->frames(), 1U);
  EXPECT_EQ((*log)->lost_bytes(), whole.size() - sizes_[0]);
  // What a file system leaves after a power cut.
  put(whole + std::string(4096, '\0'));
  log = ReplayLog::open(path_);
  ASSERT_TRUE(log.has_value());
  EXPECT_EQ((*log)->pieces(), 3U);
  EXPECT_EQ((*log)->lost_bytes(), 4096U);
}

TEST_F(ReplayLogTest, AnyOtherFileIsRefused) {
  EXPECT_FALSE(ReplayLog::open(path_).has_value());  // none
  for (const std::string bytes : {"", "CANOPEER-REPLAY 2\n", "PK\003\004 something else"}) {
    put(bytes);
    EXPECT_FALSE(ReplayLog::open(path_).has_value()) << bytes;
  }
  EXPECT_FALSE(ReplayLog::open(fs::temp_directory_path()).has_value());
}

TEST(Frame, SaysItsTypeAndLength) {
  const std::string bytes = Frame{"{\"type\":\"map\",\"view\":3}", "abc"}.bytes();
  EXPECT_EQ(bytes, "{\"type\":\"map\",\"view\":3,\"bytes\":3}\nabc");
  EXPECT_EQ(frame_type(bytes), "map");
  EXPECT_EQ(frame_type("{\"view\":3}"), "");
  EXPECT_EQ(frame_type("{\"type\":\"never ends"), "");
}

}  // namespace
}  // namespace canopeer
