// SPDX-License-Identifier: MIT
#include "web/outbox.hpp"

#include <algorithm>
#include <utility>

namespace cornerd::web {

namespace {

using message::MessageClass;

/// A second of poses and events; of large messages and of STATUS only the newest is of use.
std::ptrdiff_t most_of(MessageClass message_class) {
  switch (message_class) {
    case MessageClass::kPose:
    case MessageClass::kEvent:
    case MessageClass::kOdometry:
    case MessageClass::kOdom:
      return 16;
    default:
      return 1;
  }
}

}  // namespace

void Outbox::offer(MessageClass message_class, Line line) {
  const auto is_same = [&](const Entry& entry) { return entry.message_class == message_class; };
  if (std::count_if(waiting_.begin(), waiting_.end(), is_same) >= most_of(message_class)) {
    waiting_.erase(std::find_if(waiting_.begin(), waiting_.end(), is_same));
    ++dropped_[static_cast<std::size_t>(message_class)];
  }
  waiting_.push_back({message_class, std::move(line)});
}

void Outbox::forget_all_but_map() {
  std::erase_if(waiting_,
                [](const Entry& entry) { return entry.message_class != MessageClass::kMap; });
}

std::string Outbox::take() {
  const Entry entry = std::move(waiting_.front());
  waiting_.pop_front();
  std::string text = *entry.line;
  const auto dropped = std::exchange(dropped_[static_cast<std::size_t>(entry.message_class)], 0);
  if (dropped > 0 && text.ends_with('}')) {
    text.pop_back();
    text += ",\"dropped\":" + std::to_string(dropped) + "}";
  }
  return text;
}

}  // namespace cornerd::web
