// SPDX-License-Identifier: MIT
#include "drivers/rplidar/motor.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "tests/temporary_folder.hpp"

namespace cornerd::rplidar {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class DtrLine : public drivers::ByteStream {
 public:
  ReadResult read(std::span<std::uint8_t>, std::chrono::milliseconds) override { return {}; }
  bool write(std::span<const std::uint8_t>) override { return true; }
  void discard_input() override {}
  bool set_dtr(bool asserted) override {
    history.push_back(asserted);
    return has_line;
  }
  std::vector<bool> history;
  bool has_line = true;
};

/// A folder with the files of a GPIO line or PWM channel.
class SysfsFolder {
 public:
  explicit SysfsFolder(std::initializer_list<const char*> files) {
    for (const char* file : files) std::ofstream(folder_ / file) << "?";
  }
  std::string read(const char* file) const {
    std::ifstream stream(folder_ / file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  const fs::path& path() const { return folder_.path(); }

 private:
  cornerd::test::TemporaryFolder folder_;
};

TEST(Motor, Dtr_IsClearedToStartAndSetToStop) {
  DtrLine port;
  const auto motor = make_motor({.kind = MotorKind::kDtr, .path = {}});
  EXPECT_TRUE(motor->start(port));
  EXPECT_TRUE(motor->stop(port));
  EXPECT_THAT(port.history, ElementsAre(false, true));
}

TEST(Motor, NoDtr_IsNoError) {
  DtrLine port;
  port.has_line = false;
  EXPECT_TRUE(make_motor({.kind = MotorKind::kDtr, .path = {}})->start(port));
}

TEST(Motor, Gpio_IsHighToStart) {
  const SysfsFolder line{"value"};
  DtrLine port;
  const auto motor = make_motor({.kind = MotorKind::kGpio, .path = line.path()});
  EXPECT_TRUE(motor->start(port));
  EXPECT_EQ(line.read("value"), "1");
  EXPECT_TRUE(motor->stop(port));
  EXPECT_EQ(line.read("value"), "0");
  EXPECT_TRUE(port.history.empty());
}

TEST(Motor, Pwm_WritesNanoseconds) {
  const SysfsFolder channel{"period", "duty_cycle", "enable"};
  DtrLine port;
  const auto motor =
      make_motor({.kind = MotorKind::kPwm, .path = channel.path(), .duty = 0.5, .period_s = 4e-5});
  EXPECT_TRUE(motor->start(port));
  EXPECT_EQ(channel.read("period"), "40000");
  EXPECT_EQ(channel.read("duty_cycle"), "20000");
  EXPECT_EQ(channel.read("enable"), "1");
  EXPECT_TRUE(motor->stop(port));
  EXPECT_EQ(channel.read("duty_cycle"), "0");
  EXPECT_EQ(channel.read("enable"), "0");
}

TEST(Motor, MissingSysfsFile_IsNamed) {
  const SysfsFolder empty{};
  DtrLine port;
  const auto motor = make_motor({.kind = MotorKind::kGpio, .path = empty.path()});
  EXPECT_FALSE(motor->start(port));
  EXPECT_THAT(motor->error(), HasSubstr((empty.path() / "value").string()));
  EXPECT_THAT(motor->error(), HasSubstr("No such file"));
}

}  // namespace
}  // namespace cornerd::rplidar
