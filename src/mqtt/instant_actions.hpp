// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace cornerd::mqtt {

inline constexpr std::size_t kMaxActions = 32;
inline constexpr std::size_t kMaxIdBytes = 128;

/// One action of the topic instantActions. Texts are those of the sender.
struct InstantAction {
  std::string id;
  std::string type;
  core::Pose2 T_map_base;    ///< of initPosition
  std::string map;           ///< of initPosition; may be empty
  std::string last_node;     ///< of initPosition; may be empty
  std::string problem = {};  ///< why it cannot be done; empty if it can
};

struct InstantActions {
  std::vector<InstantAction> actions;
  std::string problem;  ///< why the whole message is refused; empty if it is not
};

/// The position actions of VDA 5050 2.x (initPosition) and 3.0 (initializePosition).
bool is_init_position(std::string_view action_type);

/// Never throws. Numbers may be texts, as some masters send them.
InstantActions parse_instant_actions(std::string_view payload);

}  // namespace cornerd::mqtt
