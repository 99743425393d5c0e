#include "canopeer/dds/service.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "canopeer/cdr/messages/std_srvs.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using namespace std::chrono_literals;
using std_srvs::SetBool;
using testing_support::eventually;
using testing_support::make_node;

/// Answers with the opposite.
Server<SetBool> contrary(Node& node, const std::string& service) {
  return must(Server<SetBool>::make(node, service, [](SetBool::Request&& request, auto reply) {
    reply({!request.data, "no"});
  }));
}

TEST(Service, AnswersTheFirstCallAndAllAfterIt) {
  const auto here = make_node("here");
  const auto there = make_node("there");
  const auto server = contrary(*there, "/turn");
  auto client = must(Client<SetBool>::make(*here, "/turn"));
  ASSERT_TRUE(eventually([&] { return client.ready(); }));
  for (int i = 0; i < 100; ++i) {
    const auto response = client.call({i % 2 == 0}, 10s);
    ASSERT_TRUE(response.has_value()) << i << ": " << response.error().message;
    EXPECT_EQ(response->success, i % 2 != 0);
  }
}

}  // namespace
}  // namespace canopeer::ros
