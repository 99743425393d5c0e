#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <utility>

#include "canopeer/dds/service.h"
#include "canopeer/dds/service_dialect.h"

namespace canopeer::ros {
namespace {

/// Numbers of requests in the dialect of rmw_cyclonedds begin here; the others are numbers of
/// samples and never get there.
constexpr std::int64_t kFirstOwnNumber = std::int64_t{1} << 40;

/// Every client hears the replies to all. Until a reader is up to date they pile up in it, and one
/// must not push another out.
constexpr Qos kRepliesHeardQos{true, false, 1000};

/// Cyclone DDS drops requests of a writer that it has not discovered yet, and acknowledges them.
/// It discovers after the next heartbeat of discovery, which Fast DDS sends once a second.
constexpr std::chrono::milliseconds kDiscoveredBack{1500};

std::set<ParticipantId> participants_in(const std::vector<Guid>& endpoints) {
  std::set<ParticipantId> ids;
  for (const Guid& guid : endpoints) ids.insert(participant_of(guid));
  return ids;
}

class DdsClient final : public RawClient {
 public:
  DdsClient(Node& node, std::string service) : node_(node), service_(std::move(service)) {
    std::random_device random;
    own_ = (std::uint64_t{random()} << 32) | random();
  }
  [[nodiscard]] Expected<void> open(const std::string& request_type,
                                    const std::string& reply_type) {
    const auto base = node_.dds_name("", service_);
    if (!base) return tl::unexpected(base.error());
    service_ = *base;
    const std::string mark = new_pair_mark("clientid");
    auto writer = node_.dds_writer("rq" + *base + "Request", request_type, kServiceQos, mark);
    if (!writer) return tl::unexpected(writer.error());
    requests_ = std::move(*writer);
    auto reader = node_.dds_reader(
        "rr" + *base + "Reply", reply_type, kRepliesHeardQos,
        [this](Sample&& reply) { take(std::move(reply)); }, mark);
    if (!reader) return tl::unexpected(reader.error());
    const std::lock_guard lock(mutex_);  // `take` may run already
    replies_ = std::move(*reader);
    reply_reader_ = replies_->guid();
    return {};
  }
  ~DdsClient() override {
    replies_.reset();  // not under the lock: a reply may be taken right now
  }

  [[nodiscard]] bool ready() const override { return !servers().empty(); }

  [[nodiscard]] Expected<std::int64_t> ask(Payload request,
                                           std::function<void(Payload&&)> on_reply) override {
    const auto dialect = dialect_of(dialects());
    if (!dialect) return fail_in("service " + service_, dialect.error());
    // Held while it is written, so that the reply finds whom it is for.
    const std::lock_guard lock(mutex_);
    if (*dialect == Rmw::cyclonedds) {
      const std::int64_t number = next_own_++;
      const auto written = requests_->write(with_head(request, {own_, number}));
      if (!written) return fail_in("service " + service_, written.error());
      waiting_[number] = std::move(on_reply);
      return number;
    }
    const auto written = requests_->write(request, SampleIdentity{reply_reader_, kUnknownSequence});
    if (!written) return fail_in("service " + service_, written.error());
    waiting_[written->sequence] = std::move(on_reply);
    return written->sequence;
  }

  void forget(std::int64_t request) override {
    const std::lock_guard lock(mutex_);
    waiting_.erase(request);
  }

 private:
  /// Participants that hear requests and whose replies are heard.
  [[nodiscard]] std::set<ParticipantId> servers() const {
    std::set<ParticipantId> both = participants_in(requests_->matched());
    const std::set<ParticipantId> answering = participants_in(replies_->matched());
    std::erase_if(both, [&](const ParticipantId& id) {
      return answering.count(id) == 0 || !has_discovered_us(id);
    });
    return both;
  }
  [[nodiscard]] bool has_discovered_us(const ParticipantId& id) const {
    const auto peer = node_.participant().peer(id);
    if (!peer || peer->rmw() != Rmw::cyclonedds) return true;
    return std::chrono::steady_clock::now() > std::max(peer->since, made_) + kDiscoveredBack;
  }
  [[nodiscard]] std::set<Rmw> dialects() const {
    std::set<Rmw> dialects;
    for (const ParticipantId& id : servers()) dialects.insert(node_.participant().rmw_of(id));
    return dialects;
  }
  void take(Sample&& reply) {
    std::int64_t number = 0;
    if (node_.rmw_of(reply.identity.writer) == Rmw::cyclonedds) {
      auto parts = split_head(std::move(reply.payload));
      if (!parts) return node_.count_malformed();
      if (parts->head.client != own_) return;
      number = parts->head.sequence;
      reply.payload = std::move(parts->body);
      reply.related.reset();
    } else {
      if (!reply.related || participant_of(reply.related->writer) != node_.participant().id()) {
        return;
      }
      number = reply.related->sequence;
    }
    if (const auto on_reply = claim(number, reply.related)) on_reply(std::move(reply.payload));
  }
  /// Who waits for it, once.
  std::function<void(Payload&&)> claim(std::int64_t number,
                                       const std::optional<SampleIdentity>& related) {
    const std::lock_guard lock(mutex_);
    const bool mine = related
                          ? related->writer == reply_reader_ || related->writer == requests_->guid()
                          : number >= kFirstOwnNumber;
    const auto found = waiting_.find(number);
    if (!mine || found == waiting_.end()) return {};
    return std::move(waiting_.extract(found).mapped());
  }

  Node& node_;
  std::string service_;  ///< resolved
  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  std::uint64_t own_ = 0;  ///< tells this client's requests from those of others
  std::mutex mutex_;       ///< of what follows
  std::map<std::int64_t, std::function<void(Payload&&)>> waiting_;
  std::int64_t next_own_ = kFirstOwnNumber;
  Guid reply_reader_{};
  std::shared_ptr<Writer> requests_;
  std::shared_ptr<Reader> replies_;
};

}  // namespace

Expected<std::unique_ptr<RawClient>> make_raw_client(Node& node, const std::string& service,
                                                     const std::string& request_type,
                                                     const std::string& reply_type) {
  auto client = std::make_unique<DdsClient>(node, service);
  const auto opened = client->open(request_type, reply_type);
  if (!opened) return tl::unexpected(opened.error());
  return client;
}

}  // namespace canopeer::ros
