#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "canopeer/view/connections/view_shared.h"

namespace canopeer {

/// One browser that looks on, over a WebSocket (RFC 6455). In the server's thread.
class ViewReader : public std::enable_shared_from_this<ViewReader> {
 public:
  /// All readers are to hear of something new.
  using Tell = std::function<void()>;

  ViewReader(boost::beast::tcp_stream&& stream, ViewShared& shared);
  ~ViewReader();
  ViewReader(const ViewReader&) = delete;
  ViewReader& operator=(const ViewReader&) = delete;

  /// Answers the request that asks for a WebSocket.
  void begin(const boost::beast::http::request<boost::beast::http::empty_body>& request,
             Tell tell_all);
  /// Sends what is there, one frame after the other; called when there may be more.
  void pump();
  /// Of what is there now.
  [[nodiscard]] bool has_all() const;
  void close();

 private:
  [[nodiscard]] std::string pace();
  bool next_piece();
  void listen();
  bool talks_too_much();
  void obey(const std::string& text) const;

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  ViewShared& shared_;
  Tell tell_all_;
  bool may_steer_ = false;
  double told_speed_ = 0.0;
  bool sending_ = false;
  bool caught_up_ = false;
  std::size_t piece_ = 0;  // the next one
  std::int64_t left_out_ = 0;
  std::deque<std::string> waiting_;
  boost::beast::flat_buffer heard_;
  std::chrono::steady_clock::time_point second_began_;
  int words_ = 0;
};

}  // namespace canopeer
