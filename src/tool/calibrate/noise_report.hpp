// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "calibration/range_noise.hpp"
#include "calibration/wall_model.hpp"
#include "calibration/wall_search.hpp"

namespace cornerd::tool {

/// For people: what was measured range by range, and how far the models are from it.
std::string describe_noise(const calibration::RangeNoise& noise);

/// For config files, `simulate --noise` and `emulate --noise`: { "lidar": { "noise": ... } }.
/// `with_table`: with the measured ranges, which then count instead of floor and share.
/// `walls`: the paper's model, where it was fitted.
std::string noise_fragment(const calibration::RangeNoise& noise, bool with_table,
                           std::span<const calibration::WallPieceFit> walls);

/// For people: what the recordings at known distances say of the range's bias.
std::string describe_distances(std::span<const calibration::KnownWall> walls);
/// And of the paper's model: its pieces and what they leave. `distances_known`: else they come from
/// the recordings themselves.
std::string describe_wall_model(std::span<const calibration::WallPieceFit> fits,
                                bool distances_known);

}  // namespace cornerd::tool
