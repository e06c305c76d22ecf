// SPDX-License-Identifier: MIT
#include "drivers/stream/stream_driver.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <memory>

#include "drivers/ld/ld_protocol.hpp"
#include "drivers/ydlidar/ydlidar_protocol.hpp"
#include "tests/unit/drivers/rplidar/scripted_a1.hpp"

namespace cornerd::drivers {
namespace {

using rplidar::test::Bytes;
using testing::Contains;
using testing::HasSubstr;

/// A device's answers; `noise`: sends bytes all the time that are no packet.
struct Line {
  std::map<std::uint8_t, Bytes> answers;
  bool noise = false;
  Bytes requests = {};
};

class LinePort : public ByteStream {
 public:
  LinePort(Line& line, rplidar::test::ManualClock& clock) : line_(line), clock_(clock) {}

  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override {
    clock_.advance(timeout);
    if (line_.noise && rest_.empty()) rest_.assign(50, 0x33);
    const std::size_t count = std::min(buffer.size(), rest_.size());
    std::copy_n(rest_.begin(), count, buffer.begin());
    rest_.erase(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count));
    return {count > 0 ? ReadStatus::kData : ReadStatus::kTimeout, count};
  }
  bool write(std::span<const std::uint8_t> bytes) override {
    line_.requests.push_back(bytes[1]);
    if (line_.answers.contains(bytes[1])) rest_ = line_.answers.at(bytes[1]);
    return true;
  }
  void discard_input() override { rest_.clear(); }
  bool set_dtr(bool /*asserted*/) override { return true; }

 private:
  Line& line_;
  rplidar::test::ManualClock& clock_;
  Bytes rest_;
};

class NoSamples : public SampleSink {
 public:
  void on_sample(const core::Sample& /*sample*/) override {}
  void on_gap() override {}
};

struct Outcome {
  std::map<LidarFault, std::string> hints;
  LidarStatus last;
};

Outcome run(Line& line, std::unique_ptr<StreamProtocol> protocol, std::vector<std::uint32_t> rates,
            int seconds = 5) {
  rplidar::test::ManualClock clock;
  StreamDriver driver(
      {"/dev/lidar", std::move(rates), false}, std::move(protocol),
      [&](std::uint32_t) -> OpenResult {
        return {std::make_unique<LinePort>(line, clock), OpenError::kNone, {}};
      },
      clock);
  std::stop_source stop;
  Outcome outcome;
  clock.on_advance = [&] {
    LidarChange change;
    while (driver.take_change(change)) {
      if (change.fault != LidarFault::kNone) outcome.hints[change.fault] = change.detail.view();
    }
    outcome.last = driver.status();
    if (clock.now_ns > seconds * core::kNsPerSecond) stop.request_stop();
  };
  NoSamples sink;
  driver.run(stop.get_token(), sink);
  return outcome;
}

TEST(StreamDriver, NoiseAtEverySpeed_IsOfAnotherDriverPerhaps) {
  Line line{.answers = {}, .noise = true};
  const auto hints = run(line, std::make_unique<ld::LdProtocol>(), {230'400, 921'600}).hints;
  ASSERT_EQ(hints.size(), 1U);
  EXPECT_THAT(hints.at(LidarFault::kUnexpectedData), HasSubstr("another lidar.driver"));
}

TEST(StreamDriver, NoiseAtTheConfiguredSpeed_IsWrongBaud) {
  Line line{.answers = {}, .noise = true};
  const auto hints = run(line, std::make_unique<ld::LdProtocol>(), {57'600}).hints;
  ASSERT_EQ(hints.size(), 1U);
  EXPECT_EQ(hints.at(LidarFault::kWrongBaud),
            "/dev/lidar: bytes that are not of an LD lidar at 57600 baud; set advanced.lidar.baud");
}

TEST(StreamDriver, NoAnswerAtEverySpeed_NamesThemAll) {
  Line line;
  const auto hints =
      run(line, std::make_unique<ydlidar::YdlidarProtocol>(true), {128'000, 115'200}).hints;
  ASSERT_EQ(hints.size(), 1U);
  EXPECT_THAT(hints.at(LidarFault::kNoAnswer),
              HasSubstr("a YDLIDAR at 128000, 115200 baud (if not, set lidar.driver)"));
}

TEST(StreamDriver, SilenceOfALidarThatSendsByItself_MayBeAnother) {
  Line line;
  const auto hints = run(line, std::make_unique<ld::LdProtocol>(), {230'400, 921'600}, 9).hints;
  EXPECT_THAT(hints.at(LidarFault::kNoData),
              HasSubstr("check why not a byte comes (is its TX at the RX here?), that it is an LD "
                        "lidar at 230400, 921600 baud (if not, set lidar.driver), and that its "
                        "motor turns"));
}

TEST(YdlidarProtocol, HealthRequestOfTheSdk_IsSentWhereTheManualsIsNotAnswered) {
  const Bytes info =
      rplidar::test::from_hex("A55A140000000406 0A010102000109000300050000000000000107");
  const Bytes health = rplidar::test::from_hex("A55A0300000006020500");
  for (const std::uint8_t request : {0x91, 0x92}) {
    Line line{.answers = {{0x90, info}, {request, health}}};
    const auto outcome = run(line, std::make_unique<ydlidar::YdlidarProtocol>(true), {128'000});
    EXPECT_TRUE(outcome.hints.contains(LidarFault::kHealthError)) << int{request};
    EXPECT_THAT(line.requests, Contains(request));
    EXPECT_EQ(testing::Value(line.requests, Contains(0x92)), request == 0x92) << "asked in vain";
  }
}

}  // namespace
}  // namespace cornerd::drivers
