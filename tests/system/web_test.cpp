// SPDX-License-Identifier: MIT
// cornerd-web as a process, asked over loopback, with a daemon behind it.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <utility>

#include "daemon_process.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::system_test {
namespace {

using test::wait_until;

constexpr const char* kFoxgloveHandshake =
    "GET /foxglove HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\n"
    "Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n\r\n";

/// A connection to the server.
class HttpClient {
 public:
  explicit HttpClient(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{.tv_sec = 60, .tv_usec = 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    EXPECT_EQ(::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~HttpClient() { ::close(fd_); }
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Sends `text` again and again until the server reads no more for a second, or `most` bytes; how
  /// many went.
  std::size_t send_unread(const std::string& text, std::size_t most) const {
    std::size_t sent = 0;
    pollfd ready{.fd = fd_, .events = POLLOUT, .revents = 0};
    while (sent < most && ::poll(&ready, 1, 1000) == 1) {
      const std::size_t begin = sent % text.size();
      const ssize_t went =
          ::send(fd_, text.data() + begin, text.size() - begin, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (went < 0) break;
      sent += static_cast<std::size_t>(went);
    }
    return sent;
  }
  void send(const std::string& text) const { ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL); }
  /// Reads on until `text` has come or the server hangs up; what has come since the last call.
  std::string read_until(const std::string& text) {
    char bytes[4096];
    while (text.empty() || unread_.find(text) == std::string::npos) {
      const ssize_t got = ::recv(fd_, bytes, sizeof bytes, 0);
      if (got <= 0) return std::exchange(unread_, {});
      unread_.append(bytes, static_cast<std::size_t>(got));
    }
    const std::size_t end = unread_.find(text) + text.size();
    return std::exchange(unread_, unread_.substr(end)).substr(0, end);
  }

 private:
  int fd_;
  std::string unread_;
};

class Web : public DaemonTest {
 protected:
  DaemonProcess start_web(const std::string& listen = "127.0.0.1:0") {
    const auto path = [&](const char* name) { return (folder_ / name).string(); };
    std::filesystem::create_directory(folder_ / "maps");
    return {{"--listen", listen, "--allow-origin", "https://app.example.org", "--pose",
             path("pose.sock"), "--control", path("control.sock"), "--maps", path("maps")},
            folder_ / "web.log",
            {},
            {},
            CORNERD_WEB_BINARY};
  }
  void wait_for_port(const DaemonProcess& web) {
    const std::string start = "http://";
    std::string told;
    ASSERT_TRUE(wait_until([&] {
      told = web.output();
      return told.find(start) != std::string::npos && told.ends_with('\n');
    })) << told;
    port_ = static_cast<std::uint16_t>(std::stoi(told.substr(told.rfind(':') + 1)));
  }
  static std::string head(const std::string& request, const std::string& more = {}) {
    return request + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + more + "\r\n";
  }
  /// The whole answer to a request.
  std::string ask(const std::string& text) const {
    HttpClient client(port_);
    client.send(text);
    return client.read_until("");
  }
  std::string post(const std::string& path, const std::string& body) const {
    return ask(head("POST " + path, "Content-Type: application/json\r\nContent-Length: " +
                                        std::to_string(body.size()) + "\r\n") +
               body);
  }
  static bool is(const std::string& answer, int status) {
    return answer.starts_with("HTTP/1.1 " + std::to_string(status) + " ");
  }

  std::uint16_t port_ = 0;
};

TEST_F(Web, PageAndLastMessages_AreServed) {
  const DaemonProcess daemon = start();
  const DaemonProcess web = start_web();
  wait_for_port(web);
  const std::string page = ask(head("GET /"));
  EXPECT_TRUE(is(page, 200)) << page;
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_NE(page.find("<canvas id=\"map\""), std::string::npos);
  for (const char* path : {"/api/map", "/api/status", "/metrics", "/api/maps", "/app.js"}) {
    EXPECT_TRUE(wait_until([&] { return is(ask(head(std::string("GET ") + path)), 200); })) << path;
  }
  EXPECT_NE(ask(head("GET /api/map")).find("\"class\":\"MAP\""), std::string::npos);
  EXPECT_TRUE(is(ask(head("GET /nothing")), 404));
}

TEST_F(Web, Stream_FollowsTheDaemonThroughItsRestart) {
  const DaemonProcess web = start_web();
  wait_for_port(web);
  HttpClient stream(port_);
  stream.send(head("GET /api/events?classes=POSE"));
  {
    const DaemonProcess daemon = start();
    EXPECT_NE(stream.read_until("data: {\"class\":\"POSE\"").find("{\"class\":\"POSE\""),
              std::string::npos);
    daemon.send_signal(SIGKILL);
  }
  const std::string away = "{\"connected\":false}";
  EXPECT_NE(stream.read_until(away).find(away), std::string::npos);
  HttpClient other(port_);
  other.send(head("GET /api/events?classes=STATUS"));
  EXPECT_NE(other.read_until(away).find(away), std::string::npos);
  const DaemonProcess again = start();
  EXPECT_NE(other.read_until("\"class\":\"STATUS\"").find("{\"connected\":true}"),
            std::string::npos);
}

TEST_F(Web, Requests_AreAnsweredByTheDaemon) {
  const DaemonProcess daemon = start();
  const DaemonProcess web = start_web();
  wait_for_port(web);
  EXPECT_TRUE(wait_until([&] { return is(ask(head("GET /api/status")), 200); }));
  const std::string done = post("/api/request", R"({"class":"RELOCALIZE","id":3})");
  EXPECT_TRUE(is(done, 200) && done.find("\"id\":3") != std::string::npos) << done;
  const std::string refused =
      post("/api/request", R"({"class":"SET_POSE","x":90,"y":0,"theta":0})");
  EXPECT_TRUE(is(refused, 409)) << refused;
  EXPECT_NE(refused.find("outside"), std::string::npos) << refused;
  EXPECT_TRUE(is(post("/api/maps/check", R"({"format":"cornerd-map"})"), 422));
}

TEST_F(Web, ForeignPagesAndHugeBodies_AreRefused) {
  const DaemonProcess web = start_web();
  wait_for_port(web);
  EXPECT_TRUE(is(ask("GET / HTTP/1.1\r\nHost: evil.com\r\nConnection: close\r\n\r\n"), 403));
  EXPECT_TRUE(is(ask(head("GET /api/events", "Origin: http://evil.com\r\n")), 403));
  EXPECT_TRUE(is(ask(head("POST /api/request",
                          "Content-Type: application/json\r\nContent-Length: 1000000000\r\n")),
                 413));
  EXPECT_TRUE(
      is(ask(head("POST /api/request", "Content-Type: text/plain\r\nContent-Length: 2\r\n") + "{}"),
         415));
  // What is no HTTP costs nobody else anything.
  ask("\xff\xfe garbage\r\n\r\n");
  EXPECT_TRUE(is(ask(head("GET /")), 200));
}

TEST_F(Web, Preflight_SaysWhatAnAllowedOriginMaySend) {
  const DaemonProcess web = start_web();
  wait_for_port(web);
  const std::string answer =
      ask(head("OPTIONS /api/request", "Origin: https://app.example.org\r\n"));
  EXPECT_TRUE(is(answer, 204)) << answer;
  for (const char* line : {"Access-Control-Allow-Origin: https://app.example.org\r\n",
                           "Access-Control-Allow-Methods: GET, POST, PUT\r\n",
                           "Access-Control-Allow-Headers: Authorization, Content-Type\r\n"}) {
    EXPECT_NE(answer.find(line), std::string::npos) << line << answer;
  }
}

TEST_F(Web, Ipv4OverIpv6_IsThisMachine) {
  const DaemonProcess web = start_web("[::]:0");
  EXPECT_TRUE(wait_until([&] { return web.output().ends_with('\n'); }));
  if (web.output().find("http://[::]:") == std::string::npos) GTEST_SKIP() << web.output();
  wait_for_port(web);
  EXPECT_TRUE(is(post("/api/maps/check", "{}"), 422));
}

TEST_F(Web, FoxgloveSocket_GetsPosesUntilItGoes) {
  const DaemonProcess daemon = start();
  const DaemonProcess web = start_web();
  wait_for_port(web);
  {
    HttpClient socket(port_);
    socket.send(kFoxgloveHandshake);
    const std::string start = socket.read_until("\"advertise\"");
    EXPECT_TRUE(is(start, 101)) << start;
    EXPECT_NE(start.find("Sec-WebSocket-Protocol: foxglove.sdk.v1"), std::string::npos) << start;
    const std::string subscribe =
        R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":5},{"id":2,"channelId":4}]})";
    // RFC 6455, section 5.2: a whole text frame with a mask of zeros.
    ASSERT_LT(subscribe.size(), 126u);
    socket.send(std::string("\x81") + static_cast<char>(0x80 | subscribe.size()) +
                std::string(4, '\0') + subscribe);
    EXPECT_NE(socket.read_until("\"cubes\"").find("\"cubes\""), std::string::npos);
    const std::string pose = "\"class\":\"POSE\"";
    EXPECT_NE(socket.read_until(pose).find(pose), std::string::npos);
  }
  EXPECT_TRUE(is(ask(head("GET /")), 200));
}

TEST_F(Web, FoxgloveClientThatNeverReads_IsReadNoMore) {
  const DaemonProcess web = start_web();
  wait_for_port(web);
  HttpClient socket(port_);
  socket.send(kFoxgloveHandshake);
  socket.read_until("\"advertise\"");
  // Each frame of 4 kB gets an answer; what goes beyond the kernel's buffers waits in the server.
  constexpr std::size_t kMost = 64 * 1024 * 1024;
  const std::string frame = std::string("\x81\xfe\x10\0\0\0\0\0", 8) + std::string(4096, 'a');
  EXPECT_LT(socket.send_unread(frame, kMost), kMost);
  EXPECT_TRUE(is(ask(head("GET /")), 200));
}

TEST_F(Web, TerminateSignal_EndsItCleanly) {
  DaemonProcess web = start_web();
  wait_for_port(web);
  HttpClient stream(port_);
  stream.send(head("GET /api/events"));
  stream.read_until("\r\n\r\n");
  web.send_signal(SIGTERM);
  EXPECT_EQ(web.wait_for_exit(), 0);
}

TEST_F(Web, WhatIsNoHttp_IsToldSo) {
  const DaemonProcess web = start_web();
  wait_for_port(web);
  for (const char* text : {"nonsense\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", "\x16\x03\x01\x02\r\n\r\n",
                           "GET / HTTP/1.1\r\nHost localhost\r\n\r\n"}) {
    const std::string answer = ask(text);
    EXPECT_TRUE(is(answer, 400)) << text << answer;
    EXPECT_NE(answer.find("this is no request of HTTP/1.1"), std::string::npos) << answer;
  }
  EXPECT_TRUE(is(ask(head("GET /", "X: " + std::string(20'000, 'x') + "\r\n")), 431));
}

TEST_F(Web, Head_IsGetWithoutTheBody) {
  const DaemonProcess daemon = start();
  const DaemonProcess web = start_web();
  wait_for_port(web);
  const auto length_of = [](const std::string& answer) {
    const std::size_t at = answer.find("Content-Length: ");
    return at == std::string::npos ? std::string() : answer.substr(at, answer.find('\r', at) - at);
  };
  for (const char* path : {"/", "/app.js", "/api/maps", "/nothing"}) {
    const std::string whole = ask(head(std::string("GET ") + path));
    const std::string header = ask(head(std::string("HEAD ") + path));
    EXPECT_EQ(header.substr(0, 12), whole.substr(0, 12)) << path;
    EXPECT_EQ(length_of(header), length_of(whole)) << path;
    EXPECT_TRUE(header.ends_with("\r\n\r\n")) << header;
  }
  EXPECT_TRUE(is(ask(head("HEAD /api/events")), 200));
  EXPECT_TRUE(is(ask(head("HEAD /api/request")), 405));
  // One connection, one request after the other.
  HttpClient client(port_);
  client.send("HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n" + head("GET /nothing"));
  EXPECT_NE(client.read_until("").find("\r\n\r\nHTTP/1.1 404 "), std::string::npos);
}

TEST_F(Web, WrongOptions_AreRefusedWithTheReason) {
  const auto refusal = [&](const char* option, const std::string& value, int code) {
    DaemonProcess web({"--listen", "127.0.0.1:0", option, value}, folder_ / "web.log", {}, {},
                      CORNERD_WEB_BINARY);
    EXPECT_EQ(web.wait_for_exit(), code) << option;
    return web.output();
  };
  EXPECT_NE(refusal("--maps", (folder_ / "nope").string(), 1).find("nope: No such file"),
            std::string::npos);
  EXPECT_NE(refusal("--maps", config(), 1).find("is no folder"), std::string::npos);
  EXPECT_NE(refusal("--allow-origin", "foo", 2).find("such as https://app.example.org"),
            std::string::npos);
}

}  // namespace
}  // namespace cornerd::system_test
