// SPDX-License-Identifier: MIT
#include "daemon/outbox.hpp"

namespace cornerd::daemon {
namespace {

/// `{...}\n` becomes `{...,"dropped":n}\n`.
std::string with_dropped(const std::string& line, std::uint64_t dropped) {
  const std::size_t brace = line.size() - 2;
  return line.substr(0, brace) + ",\"dropped\":" + std::to_string(dropped) + "}\n";
}

}  // namespace

void Outbox::put(message::MessageClass message_class, std::string_view line) {
  Slot& slot = slots_[static_cast<std::size_t>(message_class)];
  if (slot.line.empty()) {
    slot.order = ++order_;
  } else {
    ++slot.dropped;
    ++dropped_;
  }
  slot.line = line;
}

void Outbox::answer(std::string_view line) { answers_.emplace_back(line); }

Outbox::Slot* Outbox::oldest() {
  Slot* oldest = nullptr;
  for (Slot& slot : slots_) {
    if (!slot.line.empty() && (oldest == nullptr || slot.order < oldest->order)) oldest = &slot;
  }
  return oldest;
}

Outbox::Result Outbox::write_line(std::string_view line, const Write& write) {
  const std::ptrdiff_t written = write(line);
  if (written < 0) return Result::kBroken;
  if (written == 0) return Result::kBlocked;
  partial_ = std::string(line.substr(static_cast<std::size_t>(written)));
  return Result::kEmpty;
}

Outbox::Result Outbox::flush(const Write& write) {
  while (true) {
    Result result = Result::kEmpty;
    if (!partial_.empty()) {
      result = write_line(std::string(partial_), write);
    } else if (!answers_.empty()) {
      result = write_line(answers_.front(), write);
      if (result == Result::kEmpty) answers_.pop_front();
    } else if (Slot* slot = oldest()) {
      result = write_line(slot->dropped > 0 ? with_dropped(slot->line, slot->dropped) : slot->line,
                          write);
      if (result == Result::kEmpty) {
        slot->line.clear();
        slot->dropped = 0;
      }
    } else {
      return Result::kEmpty;
    }
    if (result != Result::kEmpty) return result;
  }
}

}  // namespace cornerd::daemon
