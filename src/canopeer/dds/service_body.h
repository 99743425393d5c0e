#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "canopeer/dds/service.h"

// Included by service.h: what its templates do.

namespace canopeer::ros {

/// One answer, waited for by one thread and given by another.
template <class T>
class Awaited {
 public:
  void give(Expected<T> value) {
    const std::lock_guard lock(mutex_);
    value_ = std::move(value);
    given_.notify_all();
  }
  /// Nothing: `still_there` said no, or time was up.
  template <class Condition>
  [[nodiscard]] std::optional<Expected<T>> wait(std::chrono::milliseconds patience,
                                                Condition still_there) {
    constexpr std::chrono::milliseconds kLook{50};
    const auto end = std::chrono::steady_clock::now() + patience;
    std::unique_lock lock(mutex_);
    while (!value_ && std::chrono::steady_clock::now() < end) {
      given_.wait_until(lock, std::min(end, std::chrono::steady_clock::now() + kLook));
      if (value_) break;
      lock.unlock();
      const bool there = still_there();
      lock.lock();
      if (!there) break;
    }
    return std::move(value_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable given_;
  std::optional<Expected<T>> value_;
};

template <class S>
Expected<typename S::Response> Client<S>::call(const typename S::Request& request,
                                               std::chrono::milliseconds patience) {
  using Response = typename S::Response;
  const auto answer = std::make_shared<Awaited<Response>>();
  auto asked = raw_->ask(to_cdr(request), [node = node_, answer](Payload&& payload) {
    auto response = from_cdr<Response>(payload);
    if (!response) node->count_malformed();
    answer->give(std::move(response));
  });
  if (!asked) return tl::unexpected(asked.error());
  auto given = answer->wait(patience, [this] { return ready(); });
  if (given)
    return given->has_value() ? std::move(*given) : fail_in("service " + service_, given->error());
  forget(*asked);
  if (!ready()) return fail("service " + service_ + ": the server went away");
  return fail("service " + service_ + ": no answer within " + std::to_string(patience.count()) +
              " ms");
}

template <class S>
Expected<std::int64_t> Client<S>::ask(const typename S::Request& request,
                                      std::function<void(typename S::Response&&)> on_response) {
  return raw_->ask(to_cdr(request),
                   [node = node_, on_response = std::move(on_response)](Payload&& payload) {
                     auto response = from_cdr<typename S::Response>(payload);
                     if (response) {
                       on_response(std::move(*response));
                     } else {
                       node->count_malformed();
                     }
                   });
}

template <class S>
Expected<Server<S>> Server<S>::make(Node& node, const std::string& service, Handler handler) {
  auto raw =
      make_raw_server(node, service, dds_request_type<S>(), dds_response_type<S>(),
                      [&node, handler = std::move(handler)](Payload&& payload, RawReply reply) {
                        auto request = from_cdr<typename S::Request>(payload);
                        if (!request) return node.count_malformed();
                        handler(std::move(*request),
                                [reply = std::move(reply)](const typename S::Response& response) {
                                  reply(to_cdr(response));
                                });
                      });
  if (!raw) return tl::unexpected(raw.error());
  return Server(std::move(*raw));
}

}  // namespace canopeer::ros
