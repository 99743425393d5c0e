#include "canopeer/dds/discovery_info.h"

#include <gtest/gtest.h>

#include <mutex>
#include <set>

#include "canopeer/cdr/message_names.h"
#include "canopeer/cdr/messages/rmw_dds_common.h"
#include "canopeer/cdr/messages/std_msgs.h"
#include "ros_fixture.h"
#include "support/must.h"

namespace canopeer::ros {
namespace {

using namespace rmw_dds_common;
using testing_support::eventually;
using testing_support::make_node;
using testing_support::options_of;

/// A node of ROS 2 as far as others see it in lists: `N` octets an id.
template <std::size_t N>
class RosNode {
 public:
  RosNode() {
    NodeOptions options = options_of("ros_node");
    options.announce = false;
    node_ = make_node(options);
    const std::string type = dds_type<ParticipantEntitiesInfo<N>>();
    reader_ = must(node_->participant().reader(
        "ros_discovery_info", type, {true, true, 100}, [this](Sample&& sample) {
          if (participant_of(sample.identity.writer) == node_->participant().id()) return;
          const std::lock_guard lock(mutex_);
          heard_.push_back(std::move(sample.payload));
        }));
    writer_ = must(node_->participant().writer("ros_discovery_info", type, kLatchedQos));
  }
  void announce() {
    ParticipantEntitiesInfo<N> info;
    info.node_entities_info_seq.push_back({"/", "ros_node", {}, {Gid<N>{}}});
    must(writer_->write(to_cdr(info)));
  }
  /// The last list it got; it throws when it has another length, as Humble's does.
  [[nodiscard]] std::optional<ParticipantEntitiesInfo<N>> last() const {
    const std::lock_guard lock(mutex_);
    if (heard_.empty()) return std::nullopt;
    CdrReader reader(heard_.back());
    ParticipantEntitiesInfo<N> info;
    reader(info);
    return info;
  }
  [[nodiscard]] std::size_t heard() const {
    const std::lock_guard lock(mutex_);
    return heard_.size();
  }
  [[nodiscard]] bool is_matched() const { return !reader_->matched().empty(); }

 private:
  mutable std::mutex mutex_;
  std::vector<Payload> heard_;
  std::unique_ptr<Node> node_;
  std::unique_ptr<Writer> writer_;
  std::unique_ptr<Reader> reader_;
};

template <std::size_t N>
void is_listed_as_peers_do() {
  NodeOptions options = options_of("planner");
  options.ns = "/row_1";
  const auto node = make_node(options);
  const auto publisher = must(node->advertise<std_msgs::String>("/before"));
  RosNode<N> other;
  ASSERT_TRUE(eventually([&] { return other.is_matched(); }));
  EXPECT_EQ(other.heard(), 0U) << "silent until it is known how";
  other.announce();
  ASSERT_TRUE(eventually([&] { return other.heard() > 0; }));
  const auto info = other.last().value().node_entities_info_seq.at(0);
  EXPECT_EQ(info.node_namespace, "/row_1");
  EXPECT_EQ(info.node_name, "planner");
  EXPECT_EQ(info.writer_gid_seq.size(), 1U);

  auto subscription = must(node->subscribe<std_msgs::String>(
      "/after", kDefaultQos, [](std_msgs::String&&, const Guid&) {}));
  const auto readers = [&] { return other.last()->node_entities_info_seq.at(0).reader_gid_seq; };
  ASSERT_TRUE(eventually([&] { return readers().size() == 1; }));
  const Guid guid = subscription->guid();
  EXPECT_TRUE(std::equal(guid.begin(), guid.end(), readers().at(0).data.begin()));
  subscription.reset();
  EXPECT_TRUE(eventually([&] { return readers().empty(); }));
}

TEST(DiscoveryInfo, IsToldWith24OctetsToHumble) { is_listed_as_peers_do<kHumbleGid>(); }
TEST(DiscoveryInfo, IsToldWith16OctetsToIronAndLater) { is_listed_as_peers_do<kIronGid>(); }

TEST(DiscoveryInfo, IsNotToldAnyMoreWherePeersDiffer) {
  const auto node = make_node("planner");
  RosNode<kIronGid> jazzy;
  ASSERT_TRUE(eventually([&] { return jazzy.is_matched(); }));
  jazzy.announce();
  ASSERT_TRUE(eventually([&] { return jazzy.heard() > 0; }));
  RosNode<kHumbleGid> humble;
  humble.announce();
  // Once it has heard of both, new endpoints change nothing.
  std::size_t heard = 0;
  EXPECT_TRUE(eventually([&] {
    heard = jazzy.heard();
    const auto publisher = must(node->advertise<std_msgs::String>("/more"));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return jazzy.heard() == heard;
  }));
}

}  // namespace
}  // namespace canopeer::ros
