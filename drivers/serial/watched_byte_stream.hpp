// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <utility>

#include "drivers/serial/byte_stream.hpp"

namespace cornerd::drivers {

/// Tells whoever watches over a thread that it has come back from the port.
class WatchedByteStream : public ByteStream {
 public:
  WatchedByteStream(ByteStream& stream, std::function<void()> came_back)
      : stream_(stream), came_back_(std::move(came_back)) {}

  ReadResult read(std::span<std::uint8_t> buffer, std::chrono::milliseconds timeout) override {
    const ReadResult result = stream_.read(buffer, timeout);
    came_back_();
    return result;
  }

  bool write(std::span<const std::uint8_t> bytes) override {
    const bool written = stream_.write(bytes);
    came_back_();
    return written;
  }

  void discard_input() override { stream_.discard_input(); }
  bool set_dtr(bool asserted) override { return stream_.set_dtr(asserted); }

 private:
  ByteStream& stream_;
  std::function<void()> came_back_;
};

}  // namespace cornerd::drivers
