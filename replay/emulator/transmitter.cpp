// SPDX-License-Identifier: MIT
#include "replay/emulator/transmitter.hpp"

namespace cornerd::replay {

void Transmitter::queue(core::TimeNs ready_ns, std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return;
  const core::TimeNs end_ns = line_.send(ready_ns, bytes.size());
  chunks_.push_back({end_ns - line_.duration_ns(bytes.size()), {bytes.begin(), bytes.end()}, 0});
}

void Transmitter::drop_unsent(core::TimeNs now_ns) {
  while (!chunks_.empty() && chunks_.back().start_ns > now_ns) chunks_.pop_back();
  line_.free_from(chunks_.empty()
                      ? now_ns
                      : chunks_.back().start_ns + line_.duration_ns(chunks_.back().bytes.size()));
}

void Transmitter::clear(core::TimeNs now_ns) {
  chunks_.clear();
  line_.free_from(now_ns);
}

void Transmitter::take(core::TimeNs now_ns, std::vector<std::uint8_t>& out) {
  while (!chunks_.empty() && crossed_ns(chunks_.front()) <= now_ns) {
    Chunk& chunk = chunks_.front();
    out.push_back(chunk.bytes[chunk.sent++]);
    if (chunk.sent == chunk.bytes.size()) chunks_.pop_front();
  }
}

std::optional<core::TimeNs> Transmitter::next_ns() const {
  if (chunks_.empty()) return std::nullopt;
  return crossed_ns(chunks_.front());
}

}  // namespace cornerd::replay
