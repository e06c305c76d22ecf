// SPDX-License-Identifier: MIT
#include "daemon/outbox.hpp"

namespace cornerd::daemon {
namespace {

/// `{...}\n` becomes `{...,"dropped":n}\n`.
Line with_dropped(const std::string& line, std::uint64_t dropped) {
  const std::size_t brace = line.size() - 2;
  return std::make_shared<const std::string>(line.substr(0, brace) +
                                             ",\"dropped\":" + std::to_string(dropped) + "}\n");
}

}  // namespace

void Outbox::put(message::MessageClass message_class, Line line) {
  Slot& slot = slots_[static_cast<std::size_t>(message_class)];
  if (!slot.line) {
    slot.order = ++order_;
  } else {
    ++slot.dropped;
    ++dropped_;
  }
  slot.line = std::move(line);
}

Outbox::Slot* Outbox::oldest() {
  Slot* oldest = nullptr;
  for (Slot& slot : slots_) {
    if (slot.line && (oldest == nullptr || slot.order < oldest->order)) oldest = &slot;
  }
  return oldest;
}

Line Outbox::next() {
  if (!answers_.empty()) return answers_.front();
  const Slot* const slot = oldest();
  if (slot == nullptr) return nullptr;
  return slot->dropped > 0 ? with_dropped(*slot->line, slot->dropped) : slot->line;
}

void Outbox::remove_next() {
  if (!answers_.empty()) return answers_.pop_front();
  *oldest() = {};
}

Outbox::Result Outbox::flush(const Write& write) {
  while (const Line line = partial_ ? partial_ : next()) {
    const std::ptrdiff_t written = write(std::string_view(*line).substr(written_));
    if (written < 0) return Result::kBroken;
    if (written == 0) return Result::kBlocked;
    if (!partial_) remove_next();
    written_ += static_cast<std::size_t>(written);
    const bool is_whole = written_ == line->size();
    partial_ = is_whole ? nullptr : line;
    if (is_whole) written_ = 0;
  }
  return Result::kEmpty;
}

}  // namespace cornerd::daemon
