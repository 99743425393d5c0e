// Apart from the rest of the reader: together they take the compiler over 15 s.

#include <boost/beast/websocket.hpp>

#include "canopeer/view/connections/reader_words.h"
#include "canopeer/view/connections/view_reader.h"

namespace canopeer {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr std::size_t kMostWord = 1024;  // octets of a message to us

}  // namespace

void ViewReader::begin(const http::request<http::empty_body>& request, Tell tell_all) {
  tell_all_ = std::move(tell_all);
  may_steer_ = shared_.controls.steer &&
               shared_.guard.has_token({request.target().data(), request.target().size()});
  beast::get_lowest_layer(socket_).expires_never();
  auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
  timeout.idle_timeout = 2 * kViewPatience;
  socket_.set_option(timeout);
  websocket::permessage_deflate squeeze;
  squeeze.server_enable = true;
  squeeze.compLevel = 1;
  socket_.set_option(squeeze);
  socket_.read_message_max(kMostWord);
  socket_.binary(true);
  socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
    if (error) return;
    const ViewShared& shared = self->shared_;
    self->waiting_.push_back(
        greeting_frame(shared.options.live, self->may_steer_, shared.log->frames()));
    if (self->told_speed_ != shared.speed) self->waiting_.push_back(self->pace());
    self->listen();
    self->pump();
  });
}

}  // namespace canopeer
