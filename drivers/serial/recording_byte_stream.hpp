// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "drivers/serial/byte_stream.hpp"

namespace cornerd::drivers {

/// Shows an observer every byte that passes, either way, just after it did.
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

}  // namespace cornerd::drivers
