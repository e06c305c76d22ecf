// SPDX-License-Identifier: MIT
// The way from a lidar's bytes to a published pose, stage by stage, for the counter beside this:
//
//   scan_cost MAP SAMPLES
//
// drives a simulated A1 of that many samples a scan, ten scans a second at most, through a contest
// arena at 0.2 m/s. Everything runs in one thread, with the daemon's own parts; what it prints is
// for the reader to see that poses came.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/pipeline.hpp"
#include "daemon/event_loop.hpp"
#include "daemon/message_server.hpp"
#include "daemon/sample_channel.hpp"
#include "daemon/scan_publisher.hpp"
#include "drivers/rplidar/sample_stream.hpp"
#include "localizer_stages.hpp"
#include "markers.hpp"
#include "message/line_writer.hpp"
#include "replay/simulator/simulator.hpp"
#include "settings/map_file.hpp"

CORNERD_COST_STAGE(scan)
CORNERD_COST_STAGE(decode)
CORNERD_COST_STAGE(localize)
CORNERD_COST_STAGE(publish)

namespace cornerd {
namespace {

constexpr double kSpeed_m_s = 0.2;
/// Scans until the estimates of bias and noise have settled, and those that are counted.
constexpr int kScansBefore = 25;
constexpr int kScans = 20;

/// As fast as the format is, and no more than ten scans a second.
replay::SimulatorConfig lidar_of(std::size_t samples) {
  replay::SimulatorConfig config;
  config.wire = samples > 540 ? rplidar::WireFormat::kUltra : rplidar::WireFormat::kExpress;
  const double period_s = core::to_seconds(replay::nominal_sample_period_ns(config.wire));
  config.motor_hz = 1 / (period_s * static_cast<double>(samples));
  config.motor_jitter = 0;
  return config;
}

/// Stands while the localizer learns, then drives along the street of the contest arena.
replay::Motion drive(double scan_rate_hz) {
  return [begins_s = kScansBefore / scan_rate_hz](core::TimeNs t_ns, std::int64_t) {
    const double way_m = kSpeed_m_s * std::max(0.0, core::to_seconds(t_ns) - begins_s);
    return core::Pose2{0.95, 0.25 + way_m, core::kPi / 2};
  };
}

/// Connects, and reads what comes: a client as the daemon has them.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : fd_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof address.sun_path - 1);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("cannot connect to " + path.string());
    }
  }
  ~Reader() { ::close(fd_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  std::size_t read() {
    std::array<char, 4096> block;
    const ssize_t count = ::recv(fd_, block.data(), block.size(), MSG_DONTWAIT);
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }

 private:
  int fd_;
};

/// The daemon without its threads.
class Daemon {
 public:
  Daemon(std::shared_ptr<const core::WallMap> map, const replay::Motion& drive,
         const std::filesystem::path& socket)
      : pipeline_(map, {}),
        stages_(map, drive),
        server_(loop_, "0", {}),
        publisher_(server_, {.maps = {{.map = map}}}) {
    server_.listen(socket, daemon::SocketRole::kPose);
    client_.emplace(socket);
    loop_.run_once(0);
    client_->read();
  }

  /// From where the last scan began to where the next one does.
  void scan(replay::Simulator& lidar, bool counts) {
    decode(lidar, counts);
    if (counts) cost_begin_localize();
    const core::ScanResult* result = localize();
    if (counts) cost_end_localize();
    if (result == nullptr) return;
    if (counts) cost_begin_publish();
    publisher_.publish(report_);
    if (counts) cost_end_publish();
    if (counts) cost_end_scan();

    loop_.run_once(0);
    const std::size_t bytes = client_->read();
    if (!counts) return;
    std::printf("%-10s %zu samples %zu bytes\n",
                std::string(message::to_string(result->pose.state)).c_str(),
                pipeline_.scan().size(), bytes);
    stages_.count(pipeline_.scan(), *result);
  }

 private:
  /// Each packet as a read of its own. What the simulator computes is not to be counted.
  void decode(replay::Simulator& lidar, bool counts) {
    packets_.clear();
    bool begins = false;
    while (!begins) {
      const replay::WirePacket packet = lidar.next();
      packets_.push_back({{packet.bytes.begin(), packet.bytes.end()}, packet.ready_ns});
      for (const auto& sample : packet.samples) begins |= sample.starts_scan;
    }
    if (counts) cost_begin_scan();
    if (counts) cost_begin_decode();
    for (const Packet& packet : packets_) stream_.feed(packet.bytes, packet.ready_ns, channel_);
    if (counts) cost_end_decode();
  }

  const core::ScanResult* localize() {
    const core::ScanResult* last = nullptr;
    daemon::SampleChannel::Item item;
    while (channel_.pop(item)) {
      const core::ScanResult* result = pipeline_.add(item.sample);
      if (result == nullptr) continue;
      last = result;
      report_.result = *result;
      report_.scan = pipeline_.scan();
    }
    return last;
  }

  struct Packet {
    std::vector<std::uint8_t> bytes;
    core::TimeNs ready_ns;
  };

  rplidar::SampleStream stream_{{}};
  daemon::SampleChannel channel_{daemon::SampleChannel::WhenFull::kLose};
  core::Pipeline pipeline_;
  LocalizerStages stages_;
  daemon::EventLoop loop_;
  daemon::MessageServer server_;
  daemon::ScanPublisher publisher_;
  daemon::ScanReport report_;
  std::optional<Reader> client_;
  std::vector<Packet> packets_;
};

int run(const std::filesystem::path& map_file, std::size_t samples) {
  auto map = settings::load_map(map_file);
  const replay::SimulatorConfig config = lidar_of(samples);
  const replay::Motion motion = drive(config.motor_hz);
  auto scene = std::make_unique<replay::MapScene>(map, motion);
  replay::Simulator lidar(std::move(scene), config);
  const std::filesystem::path socket =
      std::filesystem::temp_directory_path() / ("cornerd-cost-" + std::to_string(::getpid()));
  Daemon daemon(std::move(map), motion, socket);
  for (int i = 0; i < kScansBefore + kScans; ++i) daemon.scan(lidar, i >= kScansBefore);
  return 0;
}

}  // namespace
}  // namespace cornerd

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: scan_cost MAP SAMPLES\n", stderr);
    return 2;
  }
  try {
    return cornerd::run(argv[1], std::strtoul(argv[2], nullptr, 10));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scan_cost: %s\n", error.what());
    return 1;
  }
}
