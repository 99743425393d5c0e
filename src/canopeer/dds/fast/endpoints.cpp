#include "canopeer/dds/fast/endpoints.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <utility>

#if CANOPEER_FAST_DDS >= 3
#include <fastdds/rtps/common/WriteParams.hpp>
#endif
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include "canopeer/dds/fast/octets_type.h"

namespace canopeer::ros {
namespace {

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

}  // namespace

std::unique_ptr<Writer> make_writer(fast::Publisher& publisher, fast::Topic& topic,
                                    Delivery& delivery, const Qos& qos,
                                    const std::string& user_data, std::function<void()> on_match) {
  auto made = std::make_unique<FastWriter>(publisher, delivery, std::move(on_match));
  if (!made->open(topic, qos, user_data)) return nullptr;
  return made;
}

std::unique_ptr<Reader> make_reader(fast::Subscriber& subscriber, fast::Topic& topic,
                                    Delivery& delivery, const Qos& qos,
                                    const std::string& user_data, std::size_t most_octets,
                                    std::function<void(Sample&&)> on_sample) {
  auto made =
      std::make_unique<FastReader>(subscriber, delivery, qos, most_octets, std::move(on_sample));
  if (!made->open(topic, qos, user_data)) return nullptr;
  return made;
}

}  // namespace canopeer::ros
