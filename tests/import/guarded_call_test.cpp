#include "canopeer/import/meshes/guarded_call.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace canopeer {
namespace {

std::string error_of(const std::function<std::string()>& call, const CallLimits& limits = {}) {
  const auto result = guarded_call(call, limits);
  return result ? "no error" : result.error().message;
}

TEST(GuardedCall, ReturnsTheBytesWhateverTheyAre) {
  std::string bytes(5'000'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i);
  const auto result = guarded_call([&] { return bytes; }, {});
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_TRUE(*result == bytes);
  EXPECT_EQ(guarded_call([] { return std::string(); }, {}).value_or("none"), "");
}

TEST(GuardedCall, AnExceptionIsAnErrorWithItsText) {
  EXPECT_EQ(error_of([]() -> std::string { throw std::runtime_error("no such thing"); }),
            "no such thing");
}

TEST(GuardedCall, OutlivesWhatEndsTheChild) {
  EXPECT_NE(error_of([]() -> std::string { std::abort(); }).find("gave up"), std::string::npos);
  EXPECT_NE(error_of([]() -> std::string {
              std::raise(SIGSEGV);
              return "";
            }).find("reader"),
            std::string::npos);
  EXPECT_NE(error_of([]() -> std::string { std::_Exit(3); }).find("without an answer"),
            std::string::npos);
}

TEST(GuardedCall, EndsWhatTakesTooMuchTime) {
  const std::string error = error_of(
      [] {
        volatile unsigned n = 0;
        while (true) n = n + 1;
        return std::string();
      },
      {1.0, 1UL << 30U});
  EXPECT_EQ(error, "its reader took more than 1 s of processor time and was ended");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(GuardedCall, RefusesTooMuchMemory) {
  if (std::getenv("CANOPEER_EMULATOR") != nullptr) GTEST_SKIP() << "qemu-user takes no limit";
  const std::string error = error_of([] { return std::string(std::size_t{1} << 30U, 'x'); },
                                     {5.0, std::size_t{64} << 20U});
  EXPECT_EQ(error, "its reader would need more memory than there is for it");
}
#endif

TEST(GuardedCall, WhatTheChildChangesOrPrintsIsLost) {
  int n = 1;
  ::testing::internal::CaptureStderr();
  const auto result = guarded_call(
      [&] {
        n = 2;
        std::fprintf(stderr, "noise\n");
        return std::string("x");
      },
      {});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(result.has_value());
  EXPECT_EQ(n, 1);
}

}  // namespace
}  // namespace canopeer
