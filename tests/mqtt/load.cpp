// SPDX-License-Identifier: MIT
// Simulated robots on one broker: the bridge's own messages, one connection each, and a master that
// counts them.
//
//   mqtt_load PORT ROBOTS HZ SECONDS
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "mqtt/vda5050.hpp"

namespace {

using namespace cornerd;
using Clock = std::chrono::steady_clock;

// MQTT 3.1.1, section 2.2.
constexpr char kConnect = 0x10;
constexpr char kPublish = 0x30;
constexpr char kSubscribe = static_cast<char>(0x82);

std::string text_field(const std::string& text) {
  return {static_cast<char>(text.size() >> 8), static_cast<char>(text.size() & 0xff)};
}

std::string packet(char type, const std::string& body) {
  std::string bytes(1, type);
  std::size_t rest = body.size();
  do {
    bytes += static_cast<char>((rest & 0x7f) | (rest > 0x7f ? 0x80 : 0));
    rest >>= 7;
  } while (rest > 0);
  return bytes + body;
}

class Connection {
 public:
  Connection(std::uint16_t port, const std::string& id)
      : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int now = 1;
    ::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &now, sizeof now);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("cannot connect: ulimit -n?");
    }
    // Clean session, no keep-alive.
    send(packet(kConnect,
                text_field("MQTT") + std::string("MQTT\x04\x02\0\0", 8) + text_field(id) + id));
    char answer[4];
    if (::recv(fd_, answer, sizeof answer, MSG_WAITALL) != 4 || answer[3] != 0) {
      throw std::runtime_error("the broker refuses");
    }
  }
  ~Connection() { ::close(fd_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void send(const std::string& bytes) const {
    if (::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
        static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("the broker is gone");
    }
  }
  int fd() const { return fd_; }

 private:
  int fd_;
};

struct Robot {
  Robot(std::uint16_t port, std::size_t number)
      : config([number] {
          mqtt::BridgeConfig made;
          made.serial = "r" + std::to_string(number);
          return made;
        }()),
        writer(config),
        connection(port, config.serial) {
    state.is_daemon_connected = true;
    state.map_name = "hall";
  }
  void publish(double t_s) {
    message::ParsedPose pose;
    pose.t_ns = core::from_seconds(t_s);
    pose.state = core::PoseState::kFix;
    pose.T_map_base = core::Pose2{t_s, -t_s, 0.5};
    pose.covariance = core::Covariance3::Identity() * 1e-6;
    state.note(pose, t_s);
    const std::string topic = writer.topic("visualization");
    connection.send(
        packet(kPublish, text_field(topic) + topic +
                             writer.visualization(state, std::chrono::system_clock::now(), t_s)));
  }
  mqtt::BridgeConfig config;
  mqtt::Vda5050 writer;
  mqtt::RobotState state;
  Connection connection;
};

/// Counts what arrives, and what is not the next of its robot.
class Master {
 public:
  explicit Master(std::uint16_t port) : connection_(port, "master") {
    const std::string filter = "uagv/v2/+/+/visualization";
    connection_.send(packet(
        kSubscribe, std::string("\0\1", 2) + text_field(filter) + filter + std::string(1, '\0')));
    thread_ = std::thread([this] { read(); });
  }
  ~Master() {
    ::shutdown(connection_.fd(), SHUT_RDWR);
    thread_.join();
  }
  std::uint64_t received() const { return received_; }
  std::uint64_t gaps() const { return gaps_; }

 private:
  void read() {
    std::string bytes;
    std::vector<char> block(1 << 18);
    for (ssize_t got = 0; (got = ::recv(connection_.fd(), block.data(), block.size(), 0)) > 0;) {
      bytes.append(block.data(), static_cast<std::size_t>(got));
      std::size_t at = 0;
      while (const std::size_t size = take(bytes, at)) at += size;
      bytes.erase(0, at);
    }
  }
  /// Bytes of the packet at `at`; 0 if it is not whole.
  std::size_t take(const std::string& bytes, std::size_t at) {
    std::size_t length = 0;
    std::size_t header = 1;
    for (unsigned char c = 0x80; (c & 0x80) != 0; ++header) {
      if (at + header >= bytes.size()) return 0;
      c = static_cast<unsigned char>(bytes[at + header]);
      length |= static_cast<std::size_t>(c & 0x7f) << (7 * (header - 1));
    }
    if (at + header + length > bytes.size()) return 0;
    if ((bytes[at] & 0xf0) == kPublish) note(bytes.substr(at + header, length));
    return header + length;
  }
  void note(const std::string& body) {
    const std::size_t topic = static_cast<std::size_t>(static_cast<unsigned char>(body[0])) << 8 |
                              static_cast<unsigned char>(body[1]);
    constexpr std::string_view kKey = "\"headerId\":";
    const std::size_t key = body.find(kKey);
    const auto id = std::strtoul(body.c_str() + key + kKey.size(), nullptr, 10);
    ++received_;
    auto& expected = next_[body.substr(2, topic)];
    if (id != expected) ++gaps_;
    expected = id + 1;
  }

  Connection connection_;
  std::map<std::string, unsigned long> next_;
  std::atomic<std::uint64_t> received_{0};
  std::atomic<std::uint64_t> gaps_{0};
  std::thread thread_;
};

void run(std::uint16_t port, std::size_t robots, double hz, double seconds) {
  Master master(port);
  std::deque<Robot> fleet;
  for (std::size_t i = 0; i < robots; ++i) fleet.emplace_back(port, i);
  const Clock::time_point began = Clock::now();
  const auto messages = static_cast<std::uint64_t>(static_cast<double>(robots) * hz * seconds);
  for (std::uint64_t i = 0; i < messages; ++i) {
    const double t_s = static_cast<double>(i) / (hz * static_cast<double>(robots));
    std::this_thread::sleep_until(began + std::chrono::duration<double>(t_s));
    fleet[i % robots].publish(t_s);
  }
  const std::chrono::duration<double> took = Clock::now() - began;
  for (int i = 0; i < 500 && master.received() < messages; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::printf("%zu robots: %llu messages in %.1f s, %llu lost, %llu out of order\n", robots,
              static_cast<unsigned long long>(messages), took.count(),
              static_cast<unsigned long long>(messages - master.received()),
              static_cast<unsigned long long>(master.gaps()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: mqtt_load PORT ROBOTS HZ SECONDS\n");
    return 2;
  }
  try {
    run(static_cast<std::uint16_t>(std::atoi(argv[1])),
        static_cast<std::size_t>(std::atoi(argv[2])), std::atof(argv[3]), std::atof(argv[4]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mqtt_load: %s\n", error.what());
    return 1;
  }
  return 0;
}
