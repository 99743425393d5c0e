#include "canopeer/view/view_server.h"

#include <gtest/gtest.h>

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <future>

namespace canopeer {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

constexpr std::string_view kPage = "<!doctype html><title>page</title>";

class ViewServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    log_ = *ReplayLog::create_unnamed();
    ASSERT_TRUE(log_->append({{"{\"type\":\"hello\"}", ""}, {"{\"type\":\"robot\"}", "abc"}}));
    ViewServerOptions options;
    options.port = 0;
    options.token = "secret";
    options.page = kPage;
    options.live = true;
    ViewControls controls;
    controls.steer = [this](SteeringWord::Kind kind) { said_.set_value(kind); };
    controls.speed = [this](double factor) { speed_.set_value(factor); };
    auto server = ViewServer::start(options, log_, std::move(controls));
    ASSERT_TRUE(server.has_value()) << server.error().message;
    server_ = std::move(*server);
  }

  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(server_->port()); }
  tcp::socket connect() {
    tcp::socket socket(context_);
    socket.connect({asio::ip::make_address("127.0.0.1"), server_->port()});
    return socket;
  }
  http::response<http::string_body> get(const std::string& target, const std::string& host_field,
                                        http::verb verb = http::verb::get) {
    tcp::socket socket = connect();
    http::request<http::string_body> request(verb, target, 11);
    request.set(http::field::host, host_field);
    http::write(socket, request);
    http::response<http::string_body> response;
    beast::flat_buffer buffer;
    http::read(socket, buffer, response);
    return response;
  }
  using Socket = websocket::stream<tcp::socket>;
  /// The error of the handshake; none: open.
  beast::error_code open(Socket& socket, const std::string& target,
                         const std::string& origin = {}) {
    socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      if (!origin.empty()) request.set(http::field::origin, origin);
    }));
    beast::error_code error;
    socket.handshake(host(), target, error);
    return error;
  }
  static std::string read(Socket& socket) {
    beast::flat_buffer buffer;
    beast::error_code error;
    socket.read(buffer, error);
    return error ? "closed" : beast::buffers_to_string(buffer.data());
  }

  asio::io_context context_;
  std::shared_ptr<ReplayLog> log_;
  std::promise<SteeringWord::Kind> said_;
  std::promise<double> speed_;
  std::unique_ptr<ViewServer> server_;
};

TEST_F(ViewServerTest, GivesThePageAndNothingElse) {
  EXPECT_EQ(server_->link(), "http://" + host() + "/?token=secret");
  const auto page = get("/?token=secret", host());
  EXPECT_EQ(page.result(), http::status::ok);
  EXPECT_EQ(page.body(), kPage);
  EXPECT_EQ(get("/", host()).result(), http::status::ok);  // looking is free on this machine
  for (const char* path : {"/report.html", "/../etc/passwd", "//", "/record", "/socket"})
    EXPECT_NE(get(path, host()).result(), http::status::ok) << path;
  EXPECT_EQ(get("/", host(), http::verb::post).result(), http::status::method_not_allowed);
}

TEST_F(ViewServerTest, RefusesOtherNamesAndPagesFromElsewhere) {
  EXPECT_EQ(get("/", "evil.example").result(), http::status::forbidden);
  EXPECT_EQ(get("/", "evil.example:" + std::to_string(server_->port())).result(),
            http::status::forbidden);
  Socket elsewhere(connect());
  EXPECT_TRUE(open(elsewhere, "/socket?token=secret", "http://evil.example"));
  Socket own(connect());
  EXPECT_FALSE(open(own, "/socket?token=secret", "http://" + host()));
}

TEST_F(ViewServerTest, ALateReaderGetsAllThatWasAndThenWhatComes) {
  Socket socket(connect());
  ASSERT_FALSE(open(socket, "/socket"));
  EXPECT_EQ(read(socket),
            "{\"type\":\"reader\",\"live\":true,\"controls\":false,\"frames\":2,\"bytes\":0}\n");
  EXPECT_EQ(read(socket), "{\"type\":\"hello\",\"bytes\":0}\n");
  EXPECT_EQ(read(socket), "{\"type\":\"robot\",\"bytes\":3}\nabc");
  EXPECT_EQ(server_->readers(), 1);
  ASSERT_TRUE(log_->append({{"{\"type\":\"end\"}", ""}}));
  EXPECT_EQ(read(socket), "{\"type\":\"end\",\"bytes\":0}\n");
}

TEST_F(ViewServerTest, WordsCountWithTheTokenOnly) {
  Socket stranger(connect());
  ASSERT_FALSE(open(stranger, "/socket?token=wrong"));
  stranger.write(asio::buffer(std::string(R"({"type":"steer","word":"stop"})")));
  Socket owner(connect());
  ASSERT_FALSE(open(owner, "/socket?token=secret"));
  EXPECT_NE(read(owner).find("\"controls\":true"), std::string::npos);
  for (const char* text : {"", "{", "[]", "7", R"({"type":7})", R"({"type":"steer"})",
                           R"({"type":"steer","word":"wait_for_person"})",
                           R"({"type":"speed","factor":-1})", R"({"type":"speed","factor":"x"})"})
    owner.write(asio::buffer(std::string(text)));
  owner.write(asio::buffer(std::string(R"({"type":"steer","word":"pause"})")));
  EXPECT_EQ(said_.get_future().get(), SteeringWord::Kind::pause);  // the first that counts
  owner.write(asio::buffer(std::string(R"({"type":"speed","factor":4})")));
  EXPECT_EQ(speed_.get_future().get(), 4.0);
}

TEST_F(ViewServerTest, AllReadersHearOfThePaceAlsoLateOnes) {
  const std::string pace = "{\"type\":\"pace\",\"factor\":4.0,\"bytes\":0}\n";
  Socket owner(connect());
  ASSERT_FALSE(open(owner, "/socket?token=secret"));
  for (int i = 0; i < 3; ++i) EXPECT_NE(read(owner), "closed");  // what there was
  owner.write(asio::buffer(std::string(R"({"type":"speed","factor":4})")));
  EXPECT_EQ(read(owner), pace);
  Socket late(connect());
  ASSERT_FALSE(open(late, "/socket"));
  EXPECT_NE(read(late).find("\"type\":\"reader\""), std::string::npos);
  EXPECT_EQ(read(late), pace);
  EXPECT_EQ(read(late), "{\"type\":\"hello\",\"bytes\":0}\n");
}

TEST_F(ViewServerTest, WhoTalksTooMuchOrTooLongIsShownTheDoor) {
  Socket chatterer(connect());
  ASSERT_FALSE(open(chatterer, "/socket?token=secret"));
  beast::error_code error;
  for (int i = 0; i < 100 && !error; ++i) chatterer.write(asio::buffer(std::string("{}")), error);
  while (read(chatterer) != "closed") {
  }
  Socket bore(connect());
  ASSERT_FALSE(open(bore, "/socket?token=secret"));
  bore.write(asio::buffer(std::string(5000, 'x')), error);
  while (read(bore) != "closed") {
  }
}

TEST_F(ViewServerTest, ThereIsRoomForEightReaders) {
  std::vector<std::unique_ptr<Socket>> sockets;
  for (int i = 0; i < 8; ++i) {
    sockets.push_back(std::make_unique<Socket>(connect()));
    ASSERT_FALSE(open(*sockets.back(), "/socket"));
  }
  Socket ninth(connect());
  EXPECT_TRUE(open(ninth, "/socket"));
}

TEST_F(ViewServerTest, HeadersWithoutEndAreCutOff) {
  tcp::socket socket = connect();
  beast::error_code error;
  const std::string line = "GET / HTTP/1.1\r\nX: " + std::string(20'000, 'a');
  asio::write(socket, asio::buffer(line), error);
  char byte = 0;
  socket.read_some(asio::buffer(&byte, 1), error);
  EXPECT_TRUE(error);
}

TEST_F(ViewServerTest, AReaderThatReadsNothingCostsNobodyAnything) {
  Socket sleeper(connect());
  ASSERT_FALSE(open(sleeper, "/socket"));
  const std::string much(100'000, 'x');
  for (int i = 0; i < 300; ++i)
    ASSERT_TRUE(log_->append({{"{\"type\":\"picture\"}", much}, {"{\"type\":\"view\"}", ""}}));
  Socket awake(connect());
  ASSERT_FALSE(open(awake, "/socket"));
  int views = 0;
  while (views < 300) {
    const std::string frame = read(awake);
    ASSERT_NE(frame, "closed");
    views += frame_type(frame) == "view" ? 1 : 0;
  }
  // Awake again it gets every view; of the pictures some may be missing, and it is told.
  views = 0;
  while (views < 300) {
    const std::string frame = read(sleeper);
    ASSERT_NE(frame, "closed");
    views += frame_type(frame) == "view" ? 1 : 0;
  }
}

TEST_F(ViewServerTest, EndsWhileBrowsersLookOnAndAsk) {
  Socket reader(connect());
  ASSERT_FALSE(open(reader, "/socket"));
  tcp::socket half = connect();
  asio::write(half, asio::buffer(std::string("GET / HTTP/1.1\r\nHost: ")));
  ASSERT_TRUE(log_->append({{"{\"type\":\"end\"}", ""}}));
  server_.reset();
  std::string last;
  for (std::string frame = read(reader); frame != "closed"; frame = read(reader)) last = frame;
  EXPECT_EQ(frame_type(last), "end");  // it got all that there was
}

TEST(ViewServer, APortThatIsTakenIsSaid) {
  const std::shared_ptr<ReplayLog> log = *ReplayLog::create_unnamed();
  ViewServerOptions options;
  options.port = 0;
  auto first = ViewServer::start(options, log);
  ASSERT_TRUE(first.has_value());
  options.port = (*first)->port();
  const auto second = ViewServer::start(options, log);
  ASSERT_FALSE(second.has_value());
  EXPECT_NE(second.error().message.find("another --view-port"), std::string::npos);
  options.address = "next door";
  EXPECT_FALSE(ViewServer::start(options, log).has_value());
}

TEST(ViewServer, TokensDiffer) {
  EXPECT_EQ(new_view_token().size(), 32U);
  EXPECT_NE(new_view_token(), new_view_token());
}

}  // namespace
}  // namespace canopeer
