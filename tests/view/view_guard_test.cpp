#include "canopeer/view/view_guard.h"

#include <gtest/gtest.h>

namespace canopeer {
namespace {

const ViewGuard kHere("127.0.0.1", 8765, "robot", "secret");
const ViewGuard kEverywhere("0.0.0.0", 8765, "robot", "secret");

TEST(ViewGuard, KnowsItsOwnNamesOnly) {
  for (const char* host : {"127.0.0.1:8765", "localhost:8765", "[::1]:8765", "localhost:9000"})
    EXPECT_TRUE(kHere.knows_host(host)) << host;
  for (const char* host : {"", "evil.example:8765", "robot:8765", "192.168.1.5:8765",
                           "localhost.evil.example:8765", "127.0.0.1:8765.com"})
    EXPECT_FALSE(kHere.knows_host(host)) << host;
  for (const char* host :
       {"192.168.1.5:8765", "robot:8765", "Robot.local:8765", "localhost:8765", "[fe80::1]:8765"})
    EXPECT_TRUE(kEverywhere.knows_host(host)) << host;
  EXPECT_FALSE(kEverywhere.knows_host("evil.example:8765"));
}

TEST(ViewGuard, APageOfAnotherSiteIsAStranger) {
  EXPECT_TRUE(kHere.knows_origin(std::nullopt, "127.0.0.1:8765"));
  EXPECT_TRUE(kHere.knows_origin("http://127.0.0.1:8765", "127.0.0.1:8765"));
  for (const char* origin : {"", "null", "http://evil.example", "https://127.0.0.1:8765",
                             "http://127.0.0.1:8000", "http://localhost:8765"})
    EXPECT_FALSE(kHere.knows_origin(origin, "127.0.0.1:8765")) << origin;
}

TEST(ViewGuard, OnThisMachineAllMayLookAndTheTokenSteers) {
  EXPECT_TRUE(kHere.may_look("/"));
  EXPECT_FALSE(kHere.has_token("/socket"));
  EXPECT_TRUE(kHere.has_token("/socket?token=secret"));
  EXPECT_TRUE(kHere.has_token("/socket?a=b&token=secret"));
  for (const char* target : {"/?token=", "/?token=secre", "/?token=secrets", "/?token=Secret",
                             "/?atoken=secret", "/token=secret"})
    EXPECT_FALSE(kHere.has_token(target)) << target;
  EXPECT_FALSE(ViewGuard("127.0.0.1", 1, "", "").has_token("/?token="));
}

TEST(ViewGuard, FromElsewhereTheTokenIsNeededToLook) {
  EXPECT_FALSE(kEverywhere.may_look("/"));
  EXPECT_TRUE(kEverywhere.may_look("/?token=secret"));
}

TEST(ViewGuard, PathsEndAtTheQuery) {
  EXPECT_EQ(path_of("/socket?token=1"), "/socket");
  EXPECT_EQ(path_of("/"), "/");
}

}  // namespace
}  // namespace canopeer
