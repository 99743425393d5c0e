#include "canopeer/view/view_server.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <chrono>
#include <deque>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <thread>
#include <utility>

#include "canopeer/base/atomic_file.h"
#include "canopeer/view/view_guard.h"

namespace canopeer {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using SteadyTime = std::chrono::steady_clock::time_point;

constexpr int kMostReaders = 8;
constexpr int kMostConnections = 32;
constexpr std::uint32_t kMostHeader = 8192;    // octets
constexpr std::size_t kMostWord = 1024;        // octets of a message to us
constexpr int kMostWords = 20;                 // of them a second
constexpr std::size_t kFarBehind = 100;        // pieces: pictures are left out then
constexpr std::chrono::seconds kPatience(20);  // for a request, and for a frame to be taken

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

/// What all connections share. Lives in the server's thread but for the counters.
struct Shared {
  ViewServerOptions options;
  std::shared_ptr<ReplayLog> log;
  ViewControls controls;
  ViewGuard guard;
  double speed = 0.0;  // as said last
  std::atomic<int> readers{0};
  int connections = 0;
};

/// One browser that looks on.
class Reader : public std::enable_shared_from_this<Reader> {
 public:
  Reader(beast::tcp_stream&& stream, Shared& shared) : socket_(std::move(stream)), shared_(shared) {
    ++shared_.readers;
  }
  ~Reader() { --shared_.readers; }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// All readers are to hear of something new.
  using Tell = std::function<void()>;
  void begin(const http::request<http::empty_body>& request, Tell tell_all) {
    tell_all_ = std::move(tell_all);
    may_steer_ = shared_.controls.steer &&
                 shared_.guard.has_token({request.target().data(), request.target().size()});
    beast::get_lowest_layer(socket_).expires_never();
    auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.idle_timeout = 2 * kPatience;
    socket_.set_option(timeout);
    websocket::permessage_deflate squeeze;
    squeeze.server_enable = true;
    squeeze.compLevel = 1;
    socket_.set_option(squeeze);
    socket_.read_message_max(kMostWord);
    socket_.binary(true);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->waiting_.push_back(self->greeting());
      if (self->told_speed_ != self->shared_.speed) self->waiting_.push_back(self->pace());
      self->listen();
      self->pump();
    });
  }

  /// Sends what is there, one frame after the other; called when there may be more.
  void pump() {
    if (sending_ || !socket_.is_open()) return;
    if (told_speed_ != shared_.speed) waiting_.push_front(pace());
    if (waiting_.empty() && !next_piece()) return;
    sending_ = true;
    socket_.async_write(asio::buffer(waiting_.front()),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->sending_ = false;
                          if (error) return self->close();
                          self->waiting_.pop_front();
                          self->pump();
                        });
  }

  /// Of what is there now.
  [[nodiscard]] bool has_all() const {
    if (!beast::get_lowest_layer(socket_).socket().is_open()) return true;
    return !sending_ && waiting_.empty() && piece_ >= shared_.log->pieces();
  }

  void close() {
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

 private:
  [[nodiscard]] std::string greeting() const {
    const nlohmann::ordered_json head = {{"type", "reader"},
                                         {"live", shared_.options.live},
                                         {"controls", may_steer_},
                                         {"frames", shared_.log->frames()},
                                         {"bytes", 0}};
    return head.dump() + "\n";
  }

  [[nodiscard]] std::string pace() {
    told_speed_ = shared_.speed;
    const nlohmann::ordered_json head = {{"type", "pace"}, {"factor", shared_.speed}, {"bytes", 0}};
    return head.dump() + "\n";
  }

  /// The frames of the next piece that has any for this reader; false: there is none yet.
  bool next_piece() {
    while (waiting_.empty()) {
      const std::size_t pieces = shared_.log->pieces();
      if (piece_ >= pieces) {
        caught_up_ = true;
        return false;
      }
      // Who reads from the beginning gets all; who falls behind meanwhile has pictures left out.
      const bool hurry = caught_up_ && pieces - piece_ > kFarBehind;
      auto frames = shared_.log->piece(piece_++);
      if (!frames) {  // nothing that comes later can be understood
        socket_.async_close(websocket::close_code::normal,
                            [self = shared_from_this()](beast::error_code) { self->close(); });
        return false;
      }
      for (std::string& frame : *frames) {
        if (hurry && frame_type(frame) == "picture") {
          ++left_out_;
        } else {
          waiting_.push_back(std::move(frame));
        }
      }
      if (!hurry && left_out_ > 0) {
        waiting_.push_front("{\"type\":\"lost\",\"frames\":" + std::to_string(left_out_) +
                            ",\"bytes\":0}\n");
        left_out_ = 0;
      }
    }
    return true;
  }

  void listen() {
    socket_.async_read(heard_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->talks_too_much()) return self->close();
      if (self->may_steer_) self->obey(beast::buffers_to_string(self->heard_.data()));
      self->heard_.clear();
      self->listen();
    });
  }

  bool talks_too_much() {
    const SteadyTime now = std::chrono::steady_clock::now();
    if (now - second_began_ > std::chrono::seconds(1)) {
      second_began_ = now;
      words_ = 0;
    }
    return ++words_ > kMostWords;
  }

  /// What is no word of ours is passed over.
  void obey(const std::string& text) const {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return;
    const std::string type = json.value("type", nlohmann::json()).is_string()
                                 ? json.at("type").get<std::string>()
                                 : std::string();
    const nlohmann::json word = json.value("word", nlohmann::json());
    if (type == "steer" && word.is_string()) {
      using Kind = SteeringWord::Kind;
      for (const Kind kind : {Kind::go_on, Kind::next_segment, Kind::pause, Kind::stop}) {
        if (word.get<std::string>() == steering_name(kind)) shared_.controls.steer(kind);
      }
    }
    const nlohmann::json factor = json.value("factor", nlohmann::json());
    if (type == "speed" && factor.is_number() && shared_.controls.speed) {
      const double speed = factor.get<double>();
      if (!(speed >= 0.0 && speed <= 1e6)) return;
      shared_.controls.speed(speed);
      shared_.speed = speed;
      tell_all_();
    }
  }

  websocket::stream<beast::tcp_stream> socket_;
  Shared& shared_;
  Tell tell_all_;
  bool may_steer_ = false;
  double told_speed_ = 0.0;
  bool sending_ = false;
  bool caught_up_ = false;
  std::size_t piece_ = 0;  // the next one
  std::int64_t left_out_ = 0;
  std::deque<std::string> waiting_;
  beast::flat_buffer heard_;
  SteadyTime second_began_;
  int words_ = 0;
};

/// One request, answered and closed, or turned into a reader.
class Request : public std::enable_shared_from_this<Request> {
 public:
  /// Takes a reader in, and gives what tells all of them.
  using Adopt = std::function<Reader::Tell(const std::shared_ptr<Reader>&)>;
  Request(tcp::socket&& socket, Shared& shared, Adopt adopt)
      : stream_(std::move(socket)), shared_(shared), adopt_(std::move(adopt)) {
    ++shared_.connections;
  }
  ~Request() { --shared_.connections; }
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;

  void begin() {
    parser_.header_limit(kMostHeader);
    parser_.body_limit(0);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

 private:
  using Fields = http::request<http::empty_body>;
  [[nodiscard]] std::string field(http::field name) const {
    const auto text = parser_.get()[name];
    return {text.data(), text.size()};
  }

  void answer() {
    const Fields& request = parser_.get();
    const std::string target(request.target().data(), request.target().size());
    const std::string host = field(http::field::host);
    if (!shared_.guard.knows_host(host)) {
      return send(http::status::forbidden, "text/plain", "Use the address that was printed.\n");
    }
    if (!shared_.guard.may_look(target)) {
      return send(http::status::forbidden, "text/plain",
                  "Use the whole link that was printed: it ends with a token.\n");
    }
    if (websocket::is_upgrade(request)) return upgrade(host, target);
    if (request.method() != http::verb::get) {
      return send(http::status::method_not_allowed, "text/plain", "Only GET.\n");
    }
    const std::string_view path = path_of(target);
    if (path == "/") {
      return send(http::status::ok, "text/html; charset=utf-8", shared_.options.page,
                  "'unsafe-inline'");
    }
    if (path == "/report.html") {
      if (auto report = read_file(shared_.options.report))
        return send(http::status::ok, "text/html; charset=utf-8", *report);
    }
    send(http::status::not_found, "text/plain", "There is no such thing here.\n");
  }

  void upgrade(const std::string& host, const std::string& target) {
    const bool has_origin = parser_.get().find(http::field::origin) != parser_.get().end();
    const std::string origin = field(http::field::origin);
    const auto from = has_origin ? std::optional<std::string_view>(origin) : std::nullopt;
    if (path_of(target) != "/socket" || !shared_.guard.knows_origin(from, host)) {
      return send(http::status::forbidden, "text/plain", "Not from that page.\n");
    }
    if (shared_.readers >= kMostReaders) {
      return send(http::status::service_unavailable, "text/plain", "Too many look on already.\n");
    }
    auto reader = std::make_shared<Reader>(std::move(stream_), shared_);
    reader->begin(parser_.get(), adopt_(reader));
  }

  void send(http::status status, const char* type, std::string_view body,
            std::string_view scripts = "'none'") {
    auto response = std::make_shared<http::response<http::string_body>>(status, 11);
    response->set(http::field::content_type, type);
    response->set(http::field::cache_control, "no-store");
    response->set("X-Content-Type-Options", "nosniff");
    response->set("Referrer-Policy", "no-referrer");
    response->set(
        "Content-Security-Policy",
        "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src " +
            std::string(scripts) + "; connect-src ws://" + field(http::field::host) +
            "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response->keep_alive(false);
    response->body() = std::string(body);
    response->prepare_payload();
    stream_.expires_after(kPatience);
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response](beast::error_code, std::size_t) {
                        beast::error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kMostHeader};
  http::request_parser<http::empty_body> parser_;
  Shared& shared_;
  Adopt adopt_;
};

}  // namespace

struct ViewServer::State {
  std::unique_ptr<Shared> shared;  // outlives the connections, which the context holds
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  asio::steady_timer rest{context};
  std::vector<std::weak_ptr<Reader>> all_readers;
  std::uint16_t port = 0;
  std::jthread thread;

  void accept() {
    acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();  // no more files, say
      if (shared->connections < kMostConnections) {
        std::make_shared<Request>(std::move(socket), *shared, [this](const auto& reader) {
          std::erase_if(all_readers, [](const auto& one) { return one.expired(); });
          all_readers.push_back(reader);
          return [this] { asio::post(context, [this] { pump_all(); }); };
        })->begin();
      }
      accept();
    });
  }
  void accept_later() {
    rest.expires_after(std::chrono::milliseconds(100));
    rest.async_wait([this](beast::error_code error) {
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
  beast::error_code error;
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
      new Shared{options, std::move(log), std::move(controls),
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
