#include "canopeer/dds/participant.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

// Fast DDS 2 and 3 say the same things by other names; CMake tells which one is there.
#if CANOPEER_FAST_DDS >= 3
#include <fastdds/LibrarySettings.hpp>
#include <fastdds/rtps/common/WriteParams.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#endif
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "canopeer/dds/delivery.h"
#include "canopeer/dds/peers.h"

namespace canopeer::ros {
namespace {

namespace fast = eprosima::fastdds::dds;
namespace transports = eprosima::fastdds::rtps;
#if CANOPEER_FAST_DDS >= 3
namespace rtps = eprosima::fastdds::rtps;
const fast::ReturnCode_t kOk = fast::RETCODE_OK;
#else
namespace rtps = eprosima::fastrtps::rtps;
constexpr auto kOk = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
#endif

constexpr std::uint32_t kSocketBuffer = 4u << 20;
// Where discovery is heard (DDSI-RTPS 2.3, 9.6.1).
constexpr int kMulticastPort = 7400;
constexpr int kPortsOfDomain = 250;

// ---- Between its values and ours --------------------------------------------------------------

Guid to_guid(const rtps::GUID_t& from) {
  Guid guid{};
  std::memcpy(guid.data(), from.guidPrefix.value, 12);
  std::memcpy(guid.data() + 12, from.entityId.value, 4);
  return guid;
}

rtps::GUID_t from_guid(const Guid& from) {
  rtps::GUID_t guid;
  std::memcpy(guid.guidPrefix.value, from.data(), 12);
  std::memcpy(guid.entityId.value, from.data() + 12, 4);
  return guid;
}

SampleIdentity to_identity(const rtps::SampleIdentity& from) {
  const auto& number = from.sequence_number();
  return {to_guid(from.writer_guid()),
          (std::int64_t{number.high} << 32) | static_cast<std::int64_t>(number.low)};
}

rtps::SampleIdentity from_identity(const SampleIdentity& from) {
  rtps::SampleIdentity identity;
  identity.writer_guid(from_guid(from.writer));
  identity.sequence_number(rtps::SequenceNumber_t(static_cast<std::int32_t>(from.sequence >> 32),
                                                  static_cast<std::uint32_t>(from.sequence)));
  return identity;
}

std::vector<rtps::octet> octets_of(const std::string& text) { return {text.begin(), text.end()}; }

template <class Octets>
std::string text_of(const Octets& octets) {
  return {octets.begin(), octets.end()};
}

/// Its own complaints about a sample that was too long are all it says about that.
class LogListener final : public fast::LogConsumer {
 public:
  explicit LogListener(std::atomic<std::int64_t>& too_long) : too_long_(too_long) {}
  void Consume(const fast::Log::Entry& entry) override {
    if (entry.message.find("larger than the history payload size") != std::string::npos) {
      ++too_long_;
    }
  }

 private:
  std::atomic<std::int64_t>& too_long_;
};

/// The library has one log for a process, and writes it to the terminal if left alone. The count
/// of samples that were too long lives as long.
std::atomic<std::int64_t>& too_long_count() {
  static std::atomic<std::int64_t> count{0};
  static const bool listening = [] {
    fast::Log::ClearConsumers();
    fast::Log::SetVerbosity(fast::Log::Kind::Error);
    fast::Log::RegisterConsumer(std::make_unique<LogListener>(count));
    return true;
  }();
  static_cast<void>(listening);
  return count;
}

// ---- Payloads as they are ---------------------------------------------------------------------

/// What the library calls data: octets going out, or those that came in.
struct Octets {
  std::span<const std::uint8_t> out;
  Payload in;
};

/// Whatever the type's name: the payload, its encapsulation header included.
class OpaqueType final : public fast::TopicDataType {
 public:
#if CANOPEER_FAST_DDS >= 3
  OpaqueType(const std::string& name, std::size_t max_payload) {
    set_name(name);
    max_serialized_type_size = static_cast<std::uint32_t>(max_payload);
  }
  bool serialize(const void* const data, rtps::SerializedPayload_t& payload,
                 fast::DataRepresentationId_t) override {
    return put(*static_cast<const Octets*>(data), payload);
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) override {
    return get(payload, *static_cast<Octets*>(data));
  }
  std::uint32_t calculate_serialized_size(const void* const data,
                                          fast::DataRepresentationId_t) override {
    return static_cast<std::uint32_t>(static_cast<const Octets*>(data)->out.size());
  }
  void* create_data() override { return new Octets; }
  void delete_data(void* data) override { delete static_cast<Octets*>(data); }
  bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) override {
    return false;
  }
  bool compute_key(const void* const, rtps::InstanceHandle_t&, bool) override { return false; }
#else
  OpaqueType(const std::string& name, std::size_t max_payload) {
    setName(name.c_str());
    m_typeSize = static_cast<std::uint32_t>(max_payload);
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    return put(*static_cast<Octets*>(data), *payload);
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    return get(*payload, *static_cast<Octets*>(data));
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Octets*>(data)->out.size()); };
  }
  void* createData() override { return new Octets; }
  void deleteData(void* data) override { delete static_cast<Octets*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
#endif

 private:
  static bool put(const Octets& octets, rtps::SerializedPayload_t& payload) {
    if (octets.out.size() > payload.max_size) return false;
    std::memcpy(payload.data, octets.out.data(), octets.out.size());
    payload.length = static_cast<std::uint32_t>(octets.out.size());
    payload.encapsulation = CDR_LE;
    return true;
  }
  static bool get(const rtps::SerializedPayload_t& payload, Octets& octets) {
    octets.in.assign(payload.data, payload.data + payload.length);
    return true;
  }
};

template <class FastQos>
void fill(FastQos& to, const Qos& qos, const std::string& user_data) {
  to.reliability().kind =
      qos.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  to.durability().kind =
      qos.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  to.history().kind = fast::KEEP_LAST_HISTORY_QOS;
  to.history().depth = qos.depth;
  to.resource_limits().allocated_samples = 0;
  to.resource_limits().max_samples = 0;
  to.data_sharing().off();
  to.user_data().setValue(octets_of(user_data));
}

// ---- Writers and readers ----------------------------------------------------------------------

/// Samples that wait to be told: of what may get lost the last ones, of what must not as many as of
/// a service.
std::size_t waiting_at_most(const Qos& qos) {
  constexpr int kReliable = 1000;
  return static_cast<std::size_t>(qos.reliable ? std::max(qos.depth, kReliable) : qos.depth);
}

/// Who is matched, kept here so that asking never waits for a lock of the library.
class Matched {
 public:
  void change(int by, const rtps::InstanceHandle_t& handle) {
    Guid guid{};
    for (std::size_t i = 0; i < guid.size(); ++i) guid[i] = handle.value[i];
    const std::lock_guard lock(mutex_);
    if (by > 0) guids_.insert(guid);
    if (by < 0) guids_.erase(guid);
  }
  [[nodiscard]] std::vector<Guid> all() const {
    const std::lock_guard lock(mutex_);
    return {guids_.begin(), guids_.end()};
  }

 private:
  mutable std::mutex mutex_;
  std::set<Guid> guids_;
};

class FastWriter final : public Writer, fast::DataWriterListener {
 public:
  FastWriter(fast::Publisher& publisher, Delivery& delivery, std::function<void()> on_match)
      : publisher_(publisher), on_match_(std::move(on_match)), lane_(delivery, 1, 0) {}
  ~FastWriter() override {
    lane_.close();
    if (writer_ != nullptr) publisher_.delete_datawriter(writer_);
  }
  bool open(fast::Topic& topic, const Qos& qos, const std::string& user_data) {
    fast::DataWriterQos to = fast::DATAWRITER_QOS_DEFAULT;
    fill(to, qos, user_data);
    // Sent by whoever writes, as ROS does. And kept: a volatile writer lets go of samples when a
    // reader leaves, and may lock itself up with the thread that repeats them (seen in 2.9).
    to.publish_mode().kind = fast::SYNCHRONOUS_PUBLISH_MODE;
    to.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
    to.reliability().max_blocking_time = {1, 0};
    // Room for samples that left the history and are still held: with one only, 3.1 now and then
    // refuses to write as soon as the history is full.
    to.resource_limits().extra_samples = 32;
    to.endpoint().history_memory_policy = rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
    // What got lost is said again soon: big messages lose fragments in small socket buffers.
#if CANOPEER_FAST_DDS >= 3
    to.reliable_writer_qos().times.heartbeat_period = {0, 100'000'000};
#else
    to.reliable_writer_qos().times.heartbeatPeriod = {0, 100'000'000};
#endif
    writer_ =
        publisher_.create_datawriter(&topic, to, this, fast::StatusMask::publication_matched());
    return writer_ != nullptr;
  }
  [[nodiscard]] Guid guid() const override { return to_guid(writer_->guid()); }
  [[nodiscard]] std::vector<Guid> matched() const override { return matched_.all(); }
  [[nodiscard]] Expected<SampleIdentity> write(
      std::span<const std::uint8_t> payload,
      const std::optional<SampleIdentity>& related) override {
    Octets octets{payload, {}};
    rtps::WriteParams parameters;
    if (related) parameters.related_sample_identity(from_identity(*related));
#if CANOPEER_FAST_DDS >= 3
    const bool written = writer_->write(&octets, parameters) == kOk;
#else
    const bool written = writer_->write(&octets, parameters);
#endif
    if (!written) return fail("not sent, the queue was full for a second");
    return to_identity(parameters.sample_identity());
  }

 private:
  void on_publication_matched(fast::DataWriter*,
                              const fast::PublicationMatchedStatus& status) override {
    matched_.change(status.current_count_change, status.last_subscription_handle);
    if (on_match_) lane_.put(0, on_match_);
  }

  fast::Publisher& publisher_;
  std::function<void()> on_match_;
  Matched matched_;
  Delivery::Lane lane_;
  fast::DataWriter* writer_ = nullptr;
};

class FastReader final : public Reader, fast::DataReaderListener {
 public:
  FastReader(fast::Subscriber& subscriber, Delivery& delivery, const Qos& qos,
             std::size_t most_octets, std::function<void(Sample&&)> on_sample)
      : subscriber_(subscriber),
        on_sample_(std::move(on_sample)),
        lane_(delivery, waiting_at_most(qos), most_octets) {}
  ~FastReader() override {
    lane_.close();
    if (reader_ != nullptr) subscriber_.delete_datareader(reader_);
  }
  bool open(fast::Topic& topic, const Qos& qos, const std::string& user_data) {
    fast::DataReaderQos to = fast::DATAREADER_QOS_DEFAULT;
    fill(to, qos, user_data);
    // Only so does the library refuse what is longer than the type's size before it makes room.
    // The room it then makes is that size, but memory only where octets arrive.
    to.endpoint().history_memory_policy = rtps::PREALLOCATED_MEMORY_MODE;
    reader_ = subscriber_.create_datareader(&topic, to, this,
                                            fast::StatusMask::data_available()
                                                << fast::StatusMask::subscription_matched());
    return reader_ != nullptr;
  }
  [[nodiscard]] Guid guid() const override { return to_guid(reader_->guid()); }
  [[nodiscard]] std::vector<Guid> matched() const override { return matched_.all(); }

 private:
  void on_data_available(fast::DataReader* reader) override {
    Octets octets;
    fast::SampleInfo info;
    while (reader->take_next_sample(&octets, &info) == kOk) {
      if (!info.valid_data) continue;
      Sample sample{std::move(octets.in), to_identity(info.sample_identity), {}};
      if (info.related_sample_identity.writer_guid() != rtps::GUID_t::unknown()) {
        sample.related = to_identity(info.related_sample_identity);
      }
      const std::size_t length = sample.payload.size();
      lane_.put(length,
                [this, sample = std::move(sample)]() mutable { on_sample_(std::move(sample)); });
    }
  }
  void on_subscription_matched(fast::DataReader*,
                               const fast::SubscriptionMatchedStatus& status) override {
    matched_.change(status.current_count_change, status.last_publication_handle);
  }

  fast::Subscriber& subscriber_;
  std::function<void(Sample&&)> on_sample_;
  Matched matched_;
  Delivery::Lane lane_;
  fast::DataReader* reader_ = nullptr;
};

// ---- The participant --------------------------------------------------------------------------

std::shared_ptr<transports::UDPv4TransportDescriptor> udp_over(
    const std::vector<std::string>& interfaces) {
  auto udp = std::make_shared<transports::UDPv4TransportDescriptor>();
  udp->sendBufferSize = udp->receiveBufferSize = kSocketBuffer;
  udp->maxInitialPeersRange = 32;  // participants on one machine that are asked by their ports
  udp->interfaceWhiteList = interfaces;
  return udp;
}

/// Port 0: all that participants on that machine may have.
rtps::Locator_t address(const std::string& ipv4, int port = 0) {
  rtps::Locator_t locator;
  rtps::IPLocator::setIPv4(locator, ipv4);
  rtps::IPLocator::setPhysicalPort(locator, static_cast<std::uint16_t>(port));
  return locator;
}

fast::DomainParticipantQos qos_of(const ParticipantOptions& options) {
  fast::DomainParticipantQos qos;
  qos.name(options.name);
  qos.user_data().setValue(octets_of("enclave=/;"));
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp_over(used_interfaces(options.interfaces)));
  if (options.shared_memory) {
    auto memory = std::make_shared<transports::SharedMemTransportDescriptor>();
    memory->segment_size(16u << 20);
    qos.transport().user_transports.push_back(memory);
  }
  auto& builtin = qos.wire_protocol().builtin;
  // Named peers replace the multicast announcement, so it is named as well. Peers limited to this
  // machine listen to no multicast.
  builtin.initialPeersList.push_back(address("127.0.0.1"));
  builtin.initialPeersList.push_back(
      address("239.255.0.1", kMulticastPort + kPortsOfDomain * options.domain));
  for (const std::string& peer : options.peers) {
    builtin.initialPeersList.push_back(address(peer));
  }
  // Others notice after six seconds that this participant was killed.
  builtin.discovery_config.leaseDuration = {6, 0};
  builtin.discovery_config.leaseDuration_announcementperiod = {1, 500'000'000};
  return qos;
}

/// Readers and writers in one process talk as those in two do. The library's short cut between
/// them calls readers within writers' locks.
void no_short_cuts() {
#if CANOPEER_FAST_DDS >= 3
  eprosima::fastdds::LibrarySettings settings;
  settings.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
  fast::DomainParticipantFactory::get_instance()->set_library_settings(settings);
#else
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
#endif
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
        static_cast<std::uint32_t>(options_.domain), qos_of(options_), this,
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
    auto made = std::make_unique<FastWriter>(*publisher_, delivery_, std::move(on_match));
    if (!made->open(**to, qos, user_data)) return fail("topic " + topic + ": no writer was made");
    return made;
  }
  [[nodiscard]] Expected<std::unique_ptr<Reader>> reader(const std::string& topic,
                                                         const std::string& type, const Qos& qos,
                                                         std::function<void(Sample&&)> on_sample,
                                                         const std::string& user_data) override {
    auto from = topic_of(topic, type);
    if (!from) return tl::unexpected(from.error());
    auto made = std::make_unique<FastReader>(*subscriber_, delivery_, qos, options_.max_payload,
                                             std::move(on_sample));
    if (!made->open(**from, qos, user_data)) {
      return fail("topic " + topic + ": no reader was made");
    }
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
        fast::TypeSupport support(new OpaqueType(type, options_.max_payload));
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
