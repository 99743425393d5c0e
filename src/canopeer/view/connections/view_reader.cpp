#include "canopeer/view/connections/view_reader.h"

#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/websocket.hpp>

#include "canopeer/view/connections/reader_words.h"

namespace canopeer {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr int kMostWords = 20;           // of them a second
constexpr std::size_t kFarBehind = 100;  // pieces: pictures are left out then

}  // namespace

ViewReader::ViewReader(beast::tcp_stream&& stream, ViewShared& shared)
    : socket_(std::move(stream)), shared_(shared) {
  ++shared_.readers;
}

ViewReader::~ViewReader() { --shared_.readers; }

void ViewReader::pump() {
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

bool ViewReader::has_all() const {
  if (!beast::get_lowest_layer(socket_).socket().is_open()) return true;
  return !sending_ && waiting_.empty() && piece_ >= shared_.log->pieces();
}

void ViewReader::close() {
  beast::error_code ignored;
  beast::get_lowest_layer(socket_).socket().close(ignored);
}

std::string ViewReader::pace() {
  told_speed_ = shared_.speed;
  return pace_frame(told_speed_);
}

/// The frames of the next piece that has any for this reader; false: there is none yet.
bool ViewReader::next_piece() {
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
      waiting_.push_front(lost_frame(left_out_));
      left_out_ = 0;
    }
  }
  return true;
}

void ViewReader::listen() {
  socket_.async_read(heard_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error || self->talks_too_much()) return self->close();
    if (self->may_steer_) self->obey(beast::buffers_to_string(self->heard_.data()));
    self->heard_.clear();
    self->listen();
  });
}

bool ViewReader::talks_too_much() {
  const auto now = std::chrono::steady_clock::now();
  if (now - second_began_ > std::chrono::seconds(1)) {
    second_began_ = now;
    words_ = 0;
  }
  return ++words_ > kMostWords;
}

/// What is no word of ours is passed over.
void ViewReader::obey(const std::string& text) const {
  const auto word = reader_word(text);
  if (!word) return;
  if (const auto* kind = std::get_if<SteeringWord::Kind>(&*word)) {
    shared_.controls.steer(*kind);
  } else if (shared_.controls.speed) {
    shared_.speed = std::get<double>(*word);
    shared_.controls.speed(shared_.speed);
    tell_all_();
  }
}

}  // namespace canopeer
