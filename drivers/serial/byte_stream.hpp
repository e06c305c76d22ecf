// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>

namespace cornerd::drivers {

/// Bytes to and from a device: a serial port, or a replacement for one. One thread at a time.
/// Errors are results, never exceptions.
class ByteStream {
 public:
  enum class ReadStatus : std::uint8_t {
    kData,
    kTimeout,  ///< no byte in time
    kLost,     ///< the device is gone; permanent
  };

  struct ReadResult {
    ReadStatus status = ReadStatus::kTimeout;
    std::size_t count = 0;  ///< bytes put into the buffer
  };

  virtual ~ByteStream() = default;

  /// Waits until there are bytes, and returns what there is.
  virtual ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) = 0;
  /// How long the next reads collect bytes that stream in, since a UART wakes its reader for every
  /// few of them. Added to the latency of what the bytes carry.
  virtual void collect_for(std::chrono::milliseconds /*duration*/) {}
  /// True if all bytes were written.
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;
  /// Discards received bytes that were not read.
  virtual void discard_input() = 0;
  /// False if there is no DTR line, as on a pseudo-terminal.
  virtual bool set_dtr(bool asserted) = 0;
};

/// Reports every byte read or written to an observer.
class RecordingByteStream : public ByteStream {
 public:
  enum class Direction : std::uint8_t { kReceived, kSent };
  using Observer = std::function<void(Direction, std::span<const std::uint8_t>)>;

  RecordingByteStream(std::unique_ptr<ByteStream> stream, Observer observer)
      : stream_(std::move(stream)), observer_(std::move(observer)) {}

  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override {
    const ReadResult result = stream_->read(buffer, timeout);
    if (result.count > 0) observer_(Direction::kReceived, buffer.first(result.count));
    return result;
  }
  void collect_for(std::chrono::milliseconds duration) override { stream_->collect_for(duration); }

  bool write(std::span<const std::uint8_t> bytes) override {
    const bool written = stream_->write(bytes);
    if (written) observer_(Direction::kSent, bytes);
    return written;
  }

  void discard_input() override { stream_->discard_input(); }
  bool set_dtr(bool asserted) override { return stream_->set_dtr(asserted); }

 private:
  std::unique_ptr<ByteStream> stream_;
  Observer observer_;
};

/// Calls `on_return` after each read and write, for a watchdog of the thread.
class MonitoredByteStream : public ByteStream {
 public:
  MonitoredByteStream(ByteStream& stream, std::function<void()> on_return)
      : stream_(stream), on_return_(std::move(on_return)) {}

  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override {
    const ReadResult result = stream_.read(buffer, timeout);
    on_return_();
    return result;
  }
  void collect_for(std::chrono::milliseconds duration) override { stream_.collect_for(duration); }

  bool write(std::span<const std::uint8_t> bytes) override {
    const bool written = stream_.write(bytes);
    on_return_();
    return written;
  }

  void discard_input() override { stream_.discard_input(); }
  bool set_dtr(bool asserted) override { return stream_.set_dtr(asserted); }

 private:
  ByteStream& stream_;
  std::function<void()> on_return_;
};

}  // namespace cornerd::drivers
