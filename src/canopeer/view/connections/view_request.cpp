#include "canopeer/view/connections/view_request.h"

#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "canopeer/base/atomic_file.h"

namespace canopeer {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr int kMostReaders = 8;
constexpr std::uint32_t kMostHeader = 8192;  // octets

/// One request, answered and closed, or turned into a reader.
class Request : public std::enable_shared_from_this<Request> {
 public:
  Request(boost::asio::ip::tcp::socket&& socket, ViewShared& shared, AdoptReader adopt)
      : stream_(std::move(socket)), shared_(shared), adopt_(std::move(adopt)) {
    ++shared_.connections;
  }
  ~Request() { --shared_.connections; }
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;

  void begin() {
    parser_.header_limit(kMostHeader);
    parser_.body_limit(0);
    stream_.expires_after(kViewPatience);
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
    auto reader = std::make_shared<ViewReader>(std::move(stream_), shared_);
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
    stream_.expires_after(kViewPatience);
    http::async_write(
        stream_, *response, [self = shared_from_this(), response](beast::error_code, std::size_t) {
          beast::error_code ignored;
          self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        });
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kMostHeader};
  http::request_parser<http::empty_body> parser_;
  ViewShared& shared_;
  AdoptReader adopt_;
};

}  // namespace

void answer_request(boost::asio::ip::tcp::socket&& socket, ViewShared& shared, AdoptReader adopt) {
  std::make_shared<Request>(std::move(socket), shared, std::move(adopt))->begin();
}

}  // namespace canopeer
