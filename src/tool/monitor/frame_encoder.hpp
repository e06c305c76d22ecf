// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "tool/monitor/frame.hpp"

namespace cornerd::tool {

/// Turns frames into what a terminal of the ECMA-48 kind (xterm, tmux, the Linux console) is told:
/// of each frame no more than what differs from the one before.
class FrameEncoder {
 public:
  explicit FrameEncoder(bool colours) : colours_(colours) {}

  std::string encode(const Frame& frame);
  /// The screen has been lost or has another size: the next frame is drawn whole.
  void forget() { shown_.reset(); }

 private:
  void append_style(std::string& out, Style style) const;

  bool colours_;
  std::optional<Frame> shown_;
};

}  // namespace cornerd::tool
