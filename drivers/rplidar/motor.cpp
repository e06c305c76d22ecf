// SPDX-License-Identifier: MIT
#include "drivers/rplidar/motor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string_view>

#include "drivers/serial/file_descriptor.hpp"

namespace cornerd::rplidar {
namespace {

class NoMotor : public Motor {
 public:
  bool start(drivers::ByteStream&) override { return true; }
  bool stop(drivers::ByteStream&) override { return true; }
  const std::string& error() const override { return none_; }

 private:
  std::string none_;
};

// DTR asserted stops the motor; Linux asserts it on open. A port without DTR (an emulator's) has no
// motor.
class DtrMotor : public Motor {
 public:
  bool start(drivers::ByteStream& port) override {
    port.set_dtr(false);
    return true;
  }
  bool stop(drivers::ByteStream& port) override {
    port.set_dtr(true);
    return true;
  }
  const std::string& error() const override { return none_; }

 private:
  std::string none_;
};

class SysfsMotor : public Motor {
 public:
  explicit SysfsMotor(std::filesystem::path folder) : folder_(std::move(folder)) {}
  const std::string& error() const override { return error_; }

 protected:
  bool write(const char* name, std::string_view value) {
    const std::filesystem::path file = folder_ / name;
    const drivers::FileDescriptor fd(::open(file.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
    const bool written = fd.is_open() && ::write(fd.get(), value.data(), value.size()) ==
                                             static_cast<ssize_t>(value.size());
    if (!written) error_ = file.string() + ": " + std::strerror(errno);
    return written;
  }

 private:
  std::filesystem::path folder_;
  std::string error_;
};

class GpioMotor : public SysfsMotor {
 public:
  using SysfsMotor::SysfsMotor;
  bool start(drivers::ByteStream&) override { return write("value", "1"); }
  bool stop(drivers::ByteStream&) override { return write("value", "0"); }
};

class PwmMotor : public SysfsMotor {
 public:
  explicit PwmMotor(const MotorConfig& config)
      : SysfsMotor(config.path),
        period_ns_(std::llround(config.period_s * 1e9)),
        duty_ns_(std::llround(config.period_s * 1e9 * std::clamp(config.duty, 0.0, 1.0))) {}

  bool start(drivers::ByteStream&) override {
    // The kernel refuses a period below the current duty cycle; on an unused channel it refuses any
    // duty cycle before the period, so this first write may fail.
    write("duty_cycle", "0");
    return write("period", std::to_string(period_ns_)) &&
           write("duty_cycle", std::to_string(duty_ns_)) && write("enable", "1");
  }
  bool stop(drivers::ByteStream&) override {
    // A disabled channel may leave its pin high, so the duty cycle goes to 0 first.
    return write("duty_cycle", "0") && write("enable", "0");
  }

 private:
  long long period_ns_;
  long long duty_ns_;
};

}  // namespace

std::unique_ptr<Motor> make_motor(const MotorConfig& config) {
  switch (config.kind) {
    case MotorKind::kDtr:
      return std::make_unique<DtrMotor>();
    case MotorKind::kGpio:
      return std::make_unique<GpioMotor>(config.path);
    case MotorKind::kPwm:
      return std::make_unique<PwmMotor>(config);
    case MotorKind::kNone:
      break;
  }
  return std::make_unique<NoMotor>();
}

}  // namespace cornerd::rplidar
