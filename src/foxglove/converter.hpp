// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"
#include "foxglove/channel.hpp"
#include "message/json_text.hpp"
#include "message/parsed_line.hpp"

namespace cornerd::foxglove {

/// The daemon's lines as Foxglove's messages.
class Converter {
 public:
  /// `json`: valid during the call.
  using Emit = std::function<void(ChannelId channel, core::TimeNs t_ns, std::string_view json)>;

  Converter();

  /// One line without its newline, and what it is in each channel; nothing for lines that are no
  /// message or damaged. `now_ns`: the time of a message that has none (MAP). Returns what the
  /// damage is; empty if there is none.
  std::string convert(std::string_view line, core::TimeNs now_ns, const Emit& emit);

 private:
  void scan(const message::RecordedScan& scan, const Emit& emit);
  void pose(const message::ParsedPose& pose, std::string_view line, const Emit& emit);
  void walls(const core::FloorPlan& plan, core::TimeNs t_ns, const Emit& emit);
  void transform(core::TimeNs t_ns, std::string_view parent, std::string_view child,
                 const core::Pose2& T_parent_child, const Emit& emit);

  message::JsonText json_;
  core::Pose2 T_base_lidar_;  ///< of the last STATUS
};

}  // namespace cornerd::foxglove
