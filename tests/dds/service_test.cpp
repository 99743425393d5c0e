#include "canopeer/dds/service.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/service_dialect.h"
#include "child.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using namespace std::chrono_literals;
using canopeer::testing_support::Child;
using canopeer::testing_support::own_domain;
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
  for (int round = 0; round < 5; ++round) {  // discovery anew in each
    const auto here = make_node("here");
    const auto there = make_node("there");
    const auto server = contrary(*there, "/turn");
    auto client = must(Client<SetBool>::make(*here, "/turn"));
    ASSERT_TRUE(eventually([&] { return client.ready(); }));
    for (int i = 0; i < 20; ++i) {
      const auto response = client.call({i % 2 == 0}, 10s);
      ASSERT_TRUE(response.has_value()) << i << ": " << response.error().message;
      EXPECT_EQ(response->success, i % 2 != 0);
    }
  }
}

TEST(Service, ManyClientsGetEachItsOwnAnswer) {
  const auto there = make_node("there");
  std::atomic<int> asked{0};
  const auto server =
      must(Server<SetBool>::make(*there, "/turn", [&](SetBool::Request&& request, auto reply) {
        ++asked;
        reply({!request.data, "no"});
      }));
  std::atomic<int> right{0};
  std::vector<std::jthread> askers;
  for (int k = 0; k < 4; ++k) {
    askers.emplace_back([&, k] {
      const auto here = make_node("here_" + std::to_string(k));
      auto first = must(Client<SetBool>::make(*here, "/turn"));
      auto second = must(Client<SetBool>::make(*here, "/turn"));
      if (!eventually([&] { return first.ready() && second.ready(); })) return;
      for (int i = 0; i < 50; ++i) {
        const auto yes = first.call({true}, 20s);
        const auto no = second.call({false}, 20s);
        if (yes && !yes->success && no && no->success) ++right;
      }
    });
  }
  askers.clear();
  EXPECT_EQ(right, 200);
  EXPECT_EQ(asked, 400);
}

TEST(Service, AnswersMayComeLaterAndFromAnotherThread) {
  const auto here = make_node("here");
  const auto there = make_node("there");
  std::mutex mutex;
  std::vector<Server<SetBool>::Reply> open;
  auto server = std::make_unique<Server<SetBool>>(
      must(Server<SetBool>::make(*there, "/later", [&](SetBool::Request&&, auto reply) {
        const std::lock_guard lock(mutex);
        open.push_back(reply);
      })));
  auto client = must(Client<SetBool>::make(*here, "/later"));
  ASSERT_TRUE(eventually([&] { return client.ready(); }));
  std::atomic<int> answers{0};
  const auto count = [&](SetBool::Response&&) { ++answers; };
  must(client.ask({true}, count));
  const auto forgotten = must(client.ask({true}, count));
  must(client.ask({true}, count));
  const auto asked = [&](std::size_t n) {
    return eventually([&] {
      const std::lock_guard lock(mutex);
      return open.size() == n;
    });
  };
  ASSERT_TRUE(asked(3));
  client.forget(forgotten);
  for (const auto& reply : open) {
    reply({true, ""});
    reply({true, "twice"});
  }
  ASSERT_TRUE(eventually([&] { return answers == 2; }));
  must(client.ask({true}, count));
  ASSERT_TRUE(asked(4));
  server.reset();
  open.back()({true, "too late, and no harm"});
  EXPECT_EQ(answers, 2);
}

TEST(Service, WithoutAServerIsAnError) {
  const auto here = make_node("here");
  auto client = must(Client<SetBool>::make(*here, "nobody"));
  const auto response = client.call({true}, 1s);
  ASSERT_FALSE(response.has_value());
  EXPECT_EQ(response.error().message, "service /nobody: no server is there");
  EXPECT_FALSE(Client<SetBool>::make(*here, "no body").has_value());
}

TEST(Service, SaysWhenTheServerGoesInTheMiddle) {
  const auto here = make_node("here");
  auto there = make_node("there");
  std::atomic<bool> asked{false};
  auto server = std::make_unique<Server<SetBool>>(must(
      Server<SetBool>::make(*there, "/silent", [&](SetBool::Request&&, auto) { asked = true; })));
  auto client = must(Client<SetBool>::make(*here, "/silent"));
  ASSERT_TRUE(eventually([&] { return client.ready(); }));
  EXPECT_EQ(client.call({true}, 50ms).error().message, "service /silent: no answer within 50 ms");
  asked = false;
  std::jthread leaving([&] {
    eventually([&] { return asked.load(); });
    server.reset();
  });
  const auto response = client.call({true}, 60s);
  ASSERT_FALSE(response.has_value());
  EXPECT_EQ(response.error().message, "service /silent: the server went away");
}

TEST(Service, OfAKilledPeerIsThereAgainWithThePeer) {
  const auto here = make_node("here");
  auto client = must(Client<SetBool>::make(*here, "/turn"));
  Child first({CANOPEER_ROS_PEER, std::to_string(own_domain()), "first"});
  ASSERT_TRUE(eventually([&] { return client.ready(); }));
  EXPECT_EQ(must(client.call({true}, 10s)).message, "first");
  first.kill();
  EXPECT_FALSE(client.call({true}, 100ms).has_value());
  Child second({CANOPEER_ROS_PEER, std::to_string(own_domain()), "second"});
  ASSERT_TRUE(eventually([&] {
    const auto response = client.call({true}, 100ms);
    return response && response->message == "second";
  }));
}

TEST(Service, MalformedRequestsAndRepliesAreCounted) {
  const auto here = make_node("here");
  const auto there = make_node("there");
  const auto server = contrary(*there, "/turn");
  auto raw = must(
      make_raw_client(*here, "/turn", dds_request_type<SetBool>(), dds_response_type<SetBool>()));
  ASSERT_TRUE(eventually([&] { return raw->ready(); }));
  std::atomic<bool> answered{false};
  must(raw->ask({0, 1, 0, 0}, [&](Payload&&) { answered = true; }));
  ASSERT_TRUE(eventually([&] { return there->malformed() == 1; }));
  EXPECT_FALSE(answered);

  const auto liar =
      must(make_raw_server(*there, "/lie", dds_request_type<SetBool>(),
                           dds_response_type<SetBool>(), [](Payload&&, const RawReply& reply) {
                             reply({0, 1, 0, 0, 1, 0, 0, 0, 255, 255, 255, 255});
                           }));
  auto client = must(Client<SetBool>::make(*here, "/lie"));
  ASSERT_TRUE(eventually([&] { return client.ready(); }));
  const auto response = client.call({true}, 10s);
  ASSERT_FALSE(response.has_value());
  EXPECT_EQ(response.error().message, "service /lie: cut short");
  EXPECT_EQ(here->malformed(), 1);
}

TEST(ServiceDialect, AHeadGoesOnAndComesOff) {
  const Payload body = {0, 1, 0, 0, 7, 8, 9};
  const RequestHead head{0x1122334455667788u, -5};
  Payload headed = with_head(body, head);
  EXPECT_EQ(headed.size(), body.size() + 16);
  EXPECT_EQ(headed[4], 0x88);
  const auto parts = split_head(std::move(headed));
  ASSERT_TRUE(parts.has_value());
  EXPECT_EQ(parts->head, head);
  EXPECT_EQ(parts->body, body);
  EXPECT_FALSE(split_head({0, 1, 0, 0, 1, 2, 3}).has_value());
  EXPECT_FALSE(split_head({}).has_value());
}

TEST(ServiceDialect, OfAllServersOrAnErrorThatSaysWhatToDo) {
  EXPECT_EQ(must(dialect_of({Rmw::fastrtps})), Rmw::fastrtps);
  EXPECT_EQ(must(dialect_of({Rmw::cyclonedds})), Rmw::cyclonedds);
  EXPECT_EQ(dialect_of({}).error().message, "no server is there");
  EXPECT_NE(dialect_of({Rmw::fastrtps, Rmw::cyclonedds}).error().message.find("stop one of them"),
            std::string::npos);
  for (const std::set<Rmw>& servers :
       {std::set{Rmw::unknown}, std::set{Rmw::unknown, Rmw::fastrtps}}) {
    EXPECT_NE(dialect_of(servers).error().message.find("RMW_IMPLEMENTATION=rmw_fastrtps_cpp"),
              std::string::npos);
  }
}

TEST(ServiceDialect, MarksAreFoundInUserData) {
  const std::string mark = new_pair_mark("clientid");
  EXPECT_EQ(user_data_value("a=b;" + mark + "c=d;", "clientid"), mark.substr(9, mark.size() - 10));
  EXPECT_EQ(user_data_value("a=b", "a"), "b");
  EXPECT_EQ(user_data_value("a=b;", "clientid"), "");
  EXPECT_NE(mark, new_pair_mark("clientid"));
}

}  // namespace
}  // namespace canopeer::ros
