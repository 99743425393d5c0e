#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "canopeer/dds/node.h"

// Services in both dialects: the identity of a request travels beside it (rmw_fastrtps) or at its
// head (rmw_cyclonedds). Which one is spoken follows the peer's vendor (decision 93).

namespace canopeer::ros {

/// Untyped: payloads without the head that a dialect adds. The templates below are for use.
class RawClient {
 public:
  virtual ~RawClient() = default;
  /// A server's reader and writer are both there.
  [[nodiscard]] virtual bool ready() const = 0;
  /// Asks; `on_reply` is called once from the node's thread, or never. The error: nobody
  /// is there, or servers that speak differently.
  [[nodiscard]] virtual Expected<std::int64_t> ask(Payload request,
                                                   std::function<void(Payload&&)> on_reply) = 0;
  /// No reply is wanted any more.
  virtual void forget(std::int64_t request) = 0;
};

/// Answers once, from any thread.
using RawReply = std::function<void(const Payload&)>;
using RawHandler = std::function<void(Payload&& request, RawReply reply)>;
/// Answers as long as it lives.
class RawServer {
 public:
  virtual ~RawServer() = default;
};

[[nodiscard]] Expected<std::unique_ptr<RawClient>> make_raw_client(Node& node,
                                                                   const std::string& service,
                                                                   const std::string& request_type,
                                                                   const std::string& reply_type);
[[nodiscard]] Expected<std::unique_ptr<RawServer>> make_raw_server(Node& node,
                                                                   const std::string& service,
                                                                   const std::string& request_type,
                                                                   const std::string& reply_type,
                                                                   RawHandler handler);

/// A client of service type `S` (S::Request, S::Response). Thread-safe.
template <class S>
class Client {
 public:
  [[nodiscard]] static Expected<Client> make(Node& node, const std::string& service) {
    auto raw = make_raw_client(node, service, dds_request_type<S>(), dds_response_type<S>());
    if (!raw) return tl::unexpected(raw.error());
    return Client(&node, node.resolve(service), std::move(*raw));
  }
  [[nodiscard]] bool ready() const { return raw_->ready(); }
  /// Asks and waits for the answer. The error: nobody is there, the server went away (one that was
  /// killed is missed after some seconds only), or no answer came in time. Not from a callback of
  /// the node: that holds up the answer.
  [[nodiscard]] Expected<typename S::Response> call(const typename S::Request& request,
                                                    std::chrono::milliseconds patience);
  /// Asks; `on_response` comes from the node's thread, or never.
  [[nodiscard]] Expected<std::int64_t> ask(const typename S::Request& request,
                                           std::function<void(typename S::Response&&)> on_response);
  void forget(std::int64_t request) { raw_->forget(request); }

 private:
  Client(Node* node, std::string service, std::unique_ptr<RawClient> raw)
      : node_(node), service_(std::move(service)), raw_(std::move(raw)) {}
  Node* node_;
  std::string service_;
  std::unique_ptr<RawClient> raw_;
};

/// A server: `handler(Request&&, reply)`, in the node's thread; `reply(Response)` may be
/// called later, once, from any thread, as long as the server lives.
template <class S>
class Server {
 public:
  using Reply = std::function<void(const typename S::Response&)>;
  using Handler = std::function<void(typename S::Request&&, Reply)>;
  [[nodiscard]] static Expected<Server> make(Node& node, const std::string& service,
                                             Handler handler);

 private:
  explicit Server(std::unique_ptr<RawServer> raw) : raw_(std::move(raw)) {}
  std::unique_ptr<RawServer> raw_;
};

}  // namespace canopeer::ros

#include "canopeer/dds/service_body.h"
