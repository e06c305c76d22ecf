// SPDX-License-Identifier: MIT
#include "web/hub.hpp"

#include <utility>

namespace cornerd::web {

namespace {

using message::MessageClass;

constexpr std::chrono::seconds kKeptTime{60};
/// A minute of an A1's scans; memory of a small board is the limit.
constexpr std::size_t kMaxKeptBytes = 5 * 1024 * 1024;

bool is_kept(MessageClass message_class) {
  return message_class != MessageClass::kMap && message_class != MessageClass::kVersion &&
         message_class != MessageClass::kBreakpoints;
}

}  // namespace

std::optional<MessageClass> class_of(std::string_view line) {
  constexpr std::string_view kStart = "{\"class\":\"";
  if (!line.starts_with(kStart)) return std::nullopt;
  line.remove_prefix(kStart.size());
  return message::message_class_from(line.substr(0, line.find('"')));
}

void Hub::note(client::Event event, std::string_view text, Clock::time_point now) {
  if (event == client::Event::kMessage) return take(text, now);
  set_connected(event == client::Event::kConnected, text);
}

void Hub::take(std::string_view line, Clock::time_point now) {
  const auto message_class = class_of(line);
  if (!message_class) return;
  const auto shared = std::make_shared<const std::string>(line);
  last_[static_cast<std::size_t>(*message_class)] = shared;
  if (is_kept(*message_class)) {
    kept_.push_back({now, shared});
    kept_bytes_ += shared->size();
    while (kept_bytes_ > kMaxKeptBytes || now - kept_.front().at > kKeptTime) {
      kept_bytes_ -= kept_.front().line->size();
      kept_.pop_front();
    }
  }
  for (Listener& listener : listeners_) {
    if (!listener.classes.contains(*message_class)) continue;
    listener.outbox.offer(*message_class, shared);
    listener.wake();
  }
}

void Hub::set_connected(bool connected, std::string_view problem) {
  connected_ = connected;
  problem_ = problem;
  for (std::size_t i = 0; i < last_.size(); ++i) {
    if (static_cast<MessageClass>(i) != MessageClass::kMap) last_[i].reset();
  }
  for (Listener& listener : listeners_) {
    listener.outbox.forget_all_but_map();
    listener.connection_changed = true;
    listener.wake();
  }
}

std::string Hub::recording(std::chrono::seconds span, Clock::time_point now) const {
  std::string text;
  text.reserve(kept_bytes_ + kept_.size());
  const auto now_is = [&](MessageClass message_class) {
    const Line line = last(message_class);
    if (line && line->size() < message::kMaxRecordedBytes) text.append(*line).push_back('\n');
  };
  now_is(MessageClass::kMap);
  now_is(MessageClass::kStatus);
  for (const Kept& kept : kept_) {
    if (now - kept.at <= span) text.append(*kept.line).push_back('\n');
  }
  return text;
}

std::string Hub::next_event(Listener& listener) const {
  if (std::exchange(listener.connection_changed, false)) {
    return std::string("event: daemon\ndata: {\"connected\":") + (connected_ ? "true" : "false") +
           "}\n\n";
  }
  return listener.outbox.empty() ? "" : "data: " + listener.outbox.take() + "\n\n";
}

Hub::Handle Hub::add(const message::ClassSet& classes, std::function<void()> wake) {
  listeners_.push_front({.classes = classes, .wake = std::move(wake), .outbox = {}});
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const auto message_class = static_cast<MessageClass>(i);
    if (last_[i] && classes.contains(message_class)) {
      listeners_.front().outbox.offer(message_class, last_[i]);
    }
  }
  return listeners_.begin();
}

}  // namespace cornerd::web
