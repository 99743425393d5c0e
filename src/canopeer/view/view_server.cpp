#include "canopeer/view/view_server.h"

#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <future>
#include <random>
#include <thread>
#include <utility>

#include "canopeer/view/connections/view_request.h"

namespace canopeer {
namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;
using ErrorCode = boost::system::error_code;

constexpr int kMostConnections = 32;

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

}  // namespace

struct ViewServer::State {
  std::unique_ptr<ViewShared> shared;  // outlives the connections, which the context holds
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  asio::steady_timer rest{context};
  std::vector<std::weak_ptr<ViewReader>> all_readers;
  std::uint16_t port = 0;
  std::jthread thread;

  void accept() {
    acceptor.async_accept([this](ErrorCode error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();  // no more files, say
      if (shared->connections < kMostConnections) {
        answer_request(std::move(socket), *shared, [this](const auto& reader) {
          std::erase_if(all_readers, [](const auto& one) { return one.expired(); });
          all_readers.push_back(reader);
          return [this] { asio::post(context, [this] { pump_all(); }); };
        });
      }
      accept();
    });
  }
  void accept_later() {
    rest.expires_after(std::chrono::milliseconds(100));
    rest.async_wait([this](ErrorCode error) {
      if (!error) accept();
    });
  }
  /// What one connection throws ends that one; a robot may be in the middle of a motion.
  void serve() {
    while (!context.stopped()) {
      try {
        context.run();
      } catch (const std::exception&) {
        continue;
      }
    }
  }
  /// Asked from another thread.
  bool all_have_all() {
    std::promise<bool> answer;
    asio::post(context, [this, &answer] {
      answer.set_value(std::all_of(all_readers.begin(), all_readers.end(), [](const auto& one) {
        const auto reader = one.lock();
        return !reader || reader->has_all();
      }));
    });
    return answer.get_future().get();
  }
  void pump_all() {
    for (const auto& one : all_readers) {
      if (const auto reader = one.lock()) reader->pump();
    }
  }
};

ViewServer::ViewServer(std::unique_ptr<State> state) : state_(std::move(state)) {}

Expected<std::unique_ptr<ViewServer>> ViewServer::start(const ViewServerOptions& options,
                                                        std::shared_ptr<ReplayLog> log,
                                                        ViewControls controls) {
  auto state = std::make_unique<State>();
  ErrorCode error;
  const auto address = asio::ip::make_address(options.address, error);
  const std::string where = options.address + ":" + std::to_string(options.port);
  if (error) return fail(options.address + ": not an address; use one like 192.168.1.5");
  const tcp::endpoint endpoint(address, options.port);
  state->acceptor.open(endpoint.protocol(), error);
  if (!error) state->acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) state->acceptor.bind(endpoint, error);
  if (!error) state->acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    return fail("cannot listen on " + where + ": " + error.message() +
                (error == asio::error::address_in_use ? "; another --view-port?" : ""));
  }
  state->port = state->acceptor.local_endpoint().port();
  state->shared.reset(
      new ViewShared{options, std::move(log), std::move(controls),
                     ViewGuard(options.address, state->port, host_name(), options.token)});
  State* const s = state.get();
  s->shared->log->on_append([s] { asio::post(s->context, [s] { s->pump_all(); }); });
  s->accept();
  s->thread = std::jthread([s] { s->serve(); });
  return std::unique_ptr<ViewServer>(new ViewServer(std::move(state)));
}

ViewServer::~ViewServer() {
  state_->shared->log->on_append({});
  // Who looks on gets the end of the run too, if it takes no longer than that.
  for (int i = 0; i < 50 && !state_->all_have_all(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  state_->context.stop();
  state_->thread.join();
}

std::string ViewServer::link() const {
  const std::string& address = state_->shared->options.address;
  const bool any = address == "0.0.0.0" || address == "::";
  const bool v6 = !any && address.find(':') != std::string::npos;
  const std::string host = any ? host_name() : v6 ? "[" + address + "]" : address;
  const std::string& token = state_->shared->options.token;
  return "http://" + host + ":" + std::to_string(state_->port) + "/" +
         (token.empty() ? "" : "?token=" + token);
}

std::uint16_t ViewServer::port() const { return state_->port; }
int ViewServer::readers() const { return state_->shared->readers; }

std::string new_view_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 32; ++i) token += "0123456789abcdef"[random() & 15U];
  return token;
}

}  // namespace canopeer
