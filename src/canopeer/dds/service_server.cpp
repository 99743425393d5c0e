#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

#include "canopeer/dds/service.h"
#include "canopeer/dds/service_dialect.h"

namespace canopeer::ros {
namespace {

using Clock = std::chrono::steady_clock;

/// How long a reply waits for a client whose reader is not discovered yet, and how many do.
constexpr std::chrono::seconds kReaderPatience{5};
constexpr std::size_t kMostWaiting = 1000;
/// Replies of one server to all its clients: one must not push another out before it is taken.
constexpr Qos kReplyQos{true, false, 1000};
constexpr Qos kRequestsHeardQos{true, false, 1000};

/// Where a reply goes and how it is said.
struct Asker {
  Rmw dialect = Rmw::fastrtps;
  Guid writer{};            ///< of the request
  SampleIdentity identity;  ///< rmw_fastrtps: said beside the reply
  RequestHead head;         ///< rmw_cyclonedds: at its head
};

/// What replies need that are given later; the server closes it when it goes.
class ReplySide {
 public:
  explicit ReplySide(Node& node) : node_(node) {}
  [[nodiscard]] Expected<void> open(const std::string& topic, const std::string& type,
                                    const std::string& mark) {
    auto writer = node_.dds_writer(topic, type, kReplyQos, mark, [this] { send_waiting(); });
    if (!writer) return tl::unexpected(writer.error());
    const std::lock_guard lock(mutex_);
    writer_ = std::move(*writer);
    return {};
  }
  /// Nothing is sent afterwards.
  void close() {
    std::shared_ptr<Writer> gone;
    {
      std::unique_lock lock(mutex_);
      gone = std::move(writer_);
      idle_.wait(lock, [this] { return sending_ == 0; });
      waiting_.clear();
    }
  }
  void reply(const Asker& asker, const Payload& payload) {
    Payload said = asker.dialect == Rmw::cyclonedds ? with_head(payload, asker.head) : payload;
    Writer* writer = begin_sending();
    if (writer == nullptr) return;
    if (hears(*writer, asker)) {
      write(*writer, asker, said);
    } else {
      keep({asker, std::move(said), Clock::now() + kReaderPatience});
      if (hears(*writer, asker)) send_kept(*writer);  // discovered just now
    }
    end_sending();
  }

 private:
  struct Kept {
    Asker asker;
    Payload payload;
    Clock::time_point deadline;
  };

  void send_waiting() {
    Writer* writer = begin_sending();
    if (writer == nullptr) return;
    send_kept(*writer);
    end_sending();
  }
  /// The writer stays until `end_sending`. Null: closed.
  Writer* begin_sending() {
    const std::lock_guard lock(mutex_);
    if (writer_ != nullptr) ++sending_;
    return writer_.get();
  }
  void end_sending() {
    const std::lock_guard lock(mutex_);
    --sending_;
    idle_.notify_all();
  }
  void keep(Kept&& kept) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(kept));
    if (waiting_.size() > kMostWaiting) waiting_.pop_front();
  }
  void send_kept(Writer& writer) {
    // One after the other: who is discovered meanwhile is looked at by the next.
    const std::lock_guard flushing(flushing_);
    std::deque<Kept> kept;
    {
      const std::lock_guard lock(mutex_);
      kept.swap(waiting_);
    }
    for (Kept& one : kept) {
      if (hears(writer, one.asker)) {
        write(writer, one.asker, one.payload);
      } else if (Clock::now() < one.deadline) {
        keep(std::move(one));
      }
    }
  }
  static void write(Writer& writer, const Asker& asker, const Payload& payload) {
    // A reply that cannot be sent is one that does not come: the client's patience is for that.
    if (asker.dialect == Rmw::cyclonedds) {
      static_cast<void>(writer.write(payload));
    } else {
      static_cast<void>(writer.write(payload, asker.identity));
    }
  }
  /// Whether the asker's reader is discovered: what is written before does not reach it.
  [[nodiscard]] bool hears(const Writer& writer, const Asker& asker) const {
    const auto asking = node_.participant().endpoint(asker.writer);
    const std::string mark = asking ? user_data_value(asking->user_data, "clientid") : "";
    for (const Guid& reader : writer.matched()) {
      if (reader == asker.identity.writer) return true;
      if (participant_of(reader) != participant_of(asker.writer)) continue;
      if (asker.dialect == Rmw::fastrtps && asker.identity.writer != asker.writer) continue;
      const auto endpoint = node_.participant().endpoint(reader);
      if (mark.empty() || !endpoint || user_data_value(endpoint->user_data, "clientid") == mark) {
        return true;
      }
    }
    return false;
  }

  Node& node_;
  std::mutex flushing_;
  std::mutex mutex_;  ///< of what follows; never held while writing
  std::condition_variable idle_;
  int sending_ = 0;
  std::deque<Kept> waiting_;
  std::shared_ptr<Writer> writer_;
};

class DdsServer final : public RawServer {
 public:
  DdsServer(Node& node, RawHandler handler)
      : node_(node), handler_(std::move(handler)), replies_(std::make_shared<ReplySide>(node)) {}
  ~DdsServer() override {
    requests_.reset();
    replies_->close();
  }
  [[nodiscard]] Expected<void> open(const std::string& service, const std::string& request_type,
                                    const std::string& reply_type) {
    const auto base = node_.dds_name("", service);
    if (!base) return tl::unexpected(base.error());
    const std::string mark = new_pair_mark("serviceid");
    const auto opened = replies_->open("rr" + *base + "Reply", reply_type, mark);
    if (!opened) return opened;
    auto reader = node_.dds_reader(
        "rq" + *base + "Request", request_type, kRequestsHeardQos,
        [this](Sample&& request) { take(std::move(request)); }, mark);
    if (!reader) return tl::unexpected(reader.error());
    requests_ = std::move(*reader);
    return {};
  }

 private:
  void take(Sample&& request) {
    Asker asker;
    asker.writer = request.identity.writer;
    asker.dialect = node_.rmw_of(asker.writer);
    if (asker.dialect == Rmw::unknown) return node_.count_malformed();
    if (asker.dialect == Rmw::cyclonedds) {
      auto parts = split_head(std::move(request.payload));
      if (!parts) return node_.count_malformed();
      asker.head = parts->head;
      request.payload = std::move(parts->body);
    } else {
      asker.identity = request.identity;
      if (request.related) asker.identity.writer = request.related->writer;
    }
    handler_(std::move(request.payload), once(asker));
  }
  [[nodiscard]] RawReply once(const Asker& asker) const {
    const auto said = std::make_shared<std::atomic_flag>();
    return [replies = std::weak_ptr(replies_), asker, said](const Payload& payload) {
      const auto to = replies.lock();
      if (to != nullptr && !said->test_and_set()) to->reply(asker, payload);
    };
  }

  Node& node_;
  const RawHandler handler_;
  const std::shared_ptr<ReplySide> replies_;
  std::shared_ptr<Reader> requests_;
};

}  // namespace

Expected<std::unique_ptr<RawServer>> make_raw_server(Node& node, const std::string& service,
                                                     const std::string& request_type,
                                                     const std::string& reply_type,
                                                     RawHandler handler) {
  auto server = std::make_unique<DdsServer>(node, std::move(handler));
  const auto opened = server->open(service, request_type, reply_type);
  if (!opened) return tl::unexpected(opened.error());
  return server;
}

}  // namespace canopeer::ros
