// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "message/request.hpp"

namespace cornerd::message {
namespace {

/// In the order of MessageClass.
constexpr std::array<std::string_view, 8> kNames = {"VERSION",  "POSE",   "SCAN",   "BREAKPOINTS",
                                                    "ODOMETRY", "STATUS", "SERIAL", "EVENT"};
static_assert(kNames.size() == static_cast<std::size_t>(MessageClass::kEvent) + 1);

}  // namespace

std::string_view to_string(MessageClass message_class) {
  return kNames[static_cast<std::size_t>(message_class)];
}

std::optional<MessageClass> message_class_from(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<MessageClass>(found - kNames.begin());
}

}  // namespace cornerd::message
