// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "drivers/rplidar/wire/byte_window.hpp"
#include "drivers/rplidar/wire/node_track.hpp"

namespace cornerd::rplidar {

struct ChainMatch {
  Verdict verdict = Verdict::kNo;
  bool continues_track = false;  ///< else: nodes for sure, of a place in the turn unknown before
};

/// Whether nodes begin at the first of `bytes`. A random byte passes a node's redundancies with
/// probability 1/4, so it takes several in a row that also turn as a lidar does: ten where nothing
/// is known, four where they go on where `track` (may be null) is after `periods` samples.
/// `final`: no more bytes will come; too few are then a no.
ChainMatch match_node_chain(std::span<const std::uint8_t> bytes, const NodeTrack* track,
                            int periods, bool final);

}  // namespace cornerd::rplidar
