#include "canopeer/dds/participant.h"

#include <chrono>
#include <map>
#include <mutex>
#include <utility>

#if CANOPEER_FAST_DDS < 3
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#endif
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "canopeer/dds/delivery.h"
#include "canopeer/dds/fast/endpoints.h"
#include "canopeer/dds/fast/library_settings.h"
#include "canopeer/dds/fast/octets_type.h"
#include "canopeer/dds/peers.h"

namespace canopeer::ros {
namespace {

template <class Bytes>
std::string text_of(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

class FastParticipant final : public Participant, fast::DomainParticipantListener {
 public:
  explicit FastParticipant(const ParticipantOptions& options) : options_(options) {}
  ~FastParticipant() override {
    if (participant_ == nullptr) return;
    participant_->set_listener(nullptr);
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  [[nodiscard]] bool open() {
    no_short_cuts();
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(options_.domain), participant_qos(options_), this,
        fast::StatusMask::none());
    if (participant_ == nullptr) return false;
    id_ = participant_of(to_guid(participant_->guid()));
    publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
    return publisher_ != nullptr && subscriber_ != nullptr;
  }

  [[nodiscard]] ParticipantId id() const override { return id_; }
  [[nodiscard]] Expected<std::unique_ptr<Writer>> writer(const std::string& topic,
                                                         const std::string& type, const Qos& qos,
                                                         const std::string& user_data,
                                                         std::function<void()> on_match) override {
    auto to = topic_of(topic, type);
    if (!to) return tl::unexpected(to.error());
    auto made = make_writer(*publisher_, **to, delivery_, qos, user_data, std::move(on_match));
    if (made == nullptr) return fail("topic " + topic + ": no writer was made");
    return made;
  }
  [[nodiscard]] Expected<std::unique_ptr<Reader>> reader(const std::string& topic,
                                                         const std::string& type, const Qos& qos,
                                                         std::function<void(Sample&&)> on_sample,
                                                         const std::string& user_data) override {
    auto from = topic_of(topic, type);
    if (!from) return tl::unexpected(from.error());
    auto made = make_reader(*subscriber_, **from, delivery_, qos, user_data, options_.max_payload,
                            std::move(on_sample));
    if (made == nullptr) return fail("topic " + topic + ": no reader was made");
    return made;
  }
  [[nodiscard]] std::vector<Peer> peers() const override { return known_.peers(); }
  [[nodiscard]] std::optional<Peer> peer(const ParticipantId& id) const override {
    return known_.peer(id);
  }
  [[nodiscard]] std::vector<Endpoint> endpoints() const override { return known_.endpoints(); }
  [[nodiscard]] std::optional<Endpoint> endpoint(const Guid& guid) const override {
    return known_.endpoint(guid);
  }
  [[nodiscard]] Rmw rmw_of(const ParticipantId& peer) const override { return known_.rmw_of(peer); }
  [[nodiscard]] std::int64_t dropped() const override { return too_long_count() - before_; }

 private:
  Expected<fast::Topic*> topic_of(const std::string& name, const std::string& type) {
    const std::lock_guard lock(mutex_);
    fast::Topic*& topic = topics_[name];
    if (topic == nullptr) {
      if (participant_->find_type(type).empty()) {
        fast::TypeSupport support(new OctetsType(type, options_.max_payload));
        support.register_type(participant_, type);
      }
      topic = participant_->create_topic(name, type, fast::TOPIC_QOS_DEFAULT);
      if (topic == nullptr) return fail("topic " + name + " of type " + type + " was not made");
    }
    if (topic->get_type_name() != type) {
      return fail("topic " + name + " carries " + topic->get_type_name() + " here, not " + type);
    }
    return topic;
  }

#if CANOPEER_FAST_DDS >= 3
  void on_participant_discovery(fast::DomainParticipant*, rtps::ParticipantDiscoveryStatus status,
                                const fast::ParticipantBuiltinTopicData& info, bool&) override {
    using Status = rtps::ParticipantDiscoveryStatus;
    const ParticipantId peer = participant_of(to_guid(info.guid));
    if (status == Status::REMOVED_PARTICIPANT || status == Status::DROPPED_PARTICIPANT) {
      known_.remove_peer(peer);
    } else if (status != Status::IGNORED_PARTICIPANT) {
      known_.put({peer,
                  {info.vendor_id[0], info.vendor_id[1]},
                  info.participant_name.to_string(),
                  text_of(info.user_data),
                  std::chrono::steady_clock::now()});
    }
  }
  void on_data_reader_discovery(fast::DomainParticipant*, rtps::ReaderDiscoveryStatus status,
                                const fast::SubscriptionBuiltinTopicData& info, bool&) override {
    discovered(info, false, status == rtps::ReaderDiscoveryStatus::REMOVED_READER);
  }
  void on_data_writer_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryStatus status,
                                const fast::PublicationBuiltinTopicData& info, bool&) override {
    discovered(info, true, status == rtps::WriterDiscoveryStatus::REMOVED_WRITER);
  }
  template <class Info>
  void discovered(const Info& info, bool writer, bool removed) {
    const Guid guid = to_guid(info.guid);
    if (removed) return known_.remove_endpoint(guid);
    known_.put(Endpoint{guid, writer, info.topic_name.to_string(), info.type_name.to_string(),
                        seen_qos(info.reliability, info.durability), text_of(info.user_data)});
  }
#else
  void on_participant_discovery(fast::DomainParticipant*,
                                rtps::ParticipantDiscoveryInfo&& discovery) override {
    const auto& info = discovery.info;
    const ParticipantId peer = participant_of(to_guid(info.m_guid));
    if (discovery.status == rtps::ParticipantDiscoveryInfo::REMOVED_PARTICIPANT ||
        discovery.status == rtps::ParticipantDiscoveryInfo::DROPPED_PARTICIPANT) {
      known_.remove_peer(peer);
    } else {
      known_.put({peer,
                  {info.m_VendorId[0], info.m_VendorId[1]},
                  info.m_participantName.to_string(),
                  text_of(info.m_userData),
                  std::chrono::steady_clock::now()});
    }
  }
  void on_subscriber_discovery(fast::DomainParticipant*,
                               rtps::ReaderDiscoveryInfo&& discovery) override {
    discovered(discovery.info, false,
               discovery.status == rtps::ReaderDiscoveryInfo::REMOVED_READER);
  }
  void on_publisher_discovery(fast::DomainParticipant*,
                              rtps::WriterDiscoveryInfo&& discovery) override {
    discovered(discovery.info, true, discovery.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER);
  }
  template <class Info>
  void discovered(const Info& info, bool writer, bool removed) {
    const Guid guid = to_guid(info.guid());
    if (removed) return known_.remove_endpoint(guid);
    known_.put(Endpoint{guid, writer, info.topicName().to_string(), info.typeName().to_string(),
                        seen_qos(info.m_qos.m_reliability, info.m_qos.m_durability),
                        text_of(info.m_qos.m_userData)});
  }
#endif
  template <class Reliability, class Durability>
  static Qos seen_qos(const Reliability& reliability, const Durability& durability) {
    return {reliability.kind == fast::RELIABLE_RELIABILITY_QOS,
            durability.kind != fast::VOLATILE_DURABILITY_QOS, 0};
  }

  const ParticipantOptions options_;
  const std::int64_t before_ = too_long_count();  ///< samples dropped in this process
  ParticipantId id_{};
  KnownPeers known_;
  Delivery delivery_;
  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::Subscriber* subscriber_ = nullptr;
  std::mutex mutex_;
  std::map<std::string, fast::Topic*> topics_;
};

}  // namespace

Expected<std::unique_ptr<Participant>> Participant::join(const ParticipantOptions& options) {
  const auto valid = check_here(options);
  if (!valid) return tl::unexpected(valid.error());
  try {
    auto participant = std::make_unique<FastParticipant>(options);
    if (!participant->open()) {
      return fail("domain " + std::to_string(options.domain) +
                  ": no DDS participant was made: are too many of them on this machine, or are "
                  "its UDP ports taken?");
    }
    return participant;
  } catch (const std::exception& error) {
    return fail("domain " + std::to_string(options.domain) + ": " + error.what());
  }
}

std::string dds_library() { return CANOPEER_DDS_LIBRARY; }

}  // namespace canopeer::ros
