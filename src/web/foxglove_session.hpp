// SPDX-License-Identifier: MIT
// Foxglove's WebSocket protocol, without the WebSocket:
// github.com/foxglove/ws-protocol, docs/spec.md; the one of its SDK has the same messages.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "core/types.hpp"
#include "foxglove/channel.hpp"
#include "foxglove/converter.hpp"

namespace cornerd::web {

/// The name to answer to an offer of `Sec-WebSocket-Protocol`; empty if none is Foxglove's.
std::string_view foxglove_protocol(std::string_view offered);

/// What one client subscribes to and publishes, and what it gets.
class FoxgloveSession {
 public:
  struct Frame {
    bool is_binary = false;
    std::string bytes;
  };

  /// Waits with the server's name and its channels. `may_publish`: the client may set the pose.
  explicit FoxgloveSession(bool may_publish);

  void on_text(std::string_view text);
  /// The request for the daemon that the client's message is; empty if it is none.
  std::string on_binary(std::string_view bytes);
  /// A line of the daemon. `now_ns`: UNIX time.
  void on_line(std::string_view line, core::TimeNs now_ns);
  void on_connection(bool is_connected);
  /// The client reads `text`.
  void tell(std::string_view text);

  /// True once after the walls were subscribed to: the map comes at a change only.
  bool take_map_wanted();
  bool has_frame() const { return !frames_.empty(); }
  Frame take_frame();

 private:
  using SubscriptionId = std::uint32_t;

  bool is_subscribed(foxglove::ChannelId channel) const;
  std::string pose_request(std::string_view json);

  const bool may_publish_;
  std::map<SubscriptionId, foxglove::ChannelId> subscriptions_;
  std::set<std::uint32_t> initial_pose_channels_;  ///< of the client
  bool map_wanted_ = false;
  foxglove::Converter converter_;
  std::deque<Frame> frames_;
};

}  // namespace cornerd::web
