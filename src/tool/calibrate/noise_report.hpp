// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "calibration/range_noise.hpp"
#include "calibration/wall_model.hpp"
#include "calibration/wall_search.hpp"

namespace cornerd::tool {

/// A table of the measured sigmas by range and the residuals of the models.
std::string describe_noise(const calibration::RangeNoise& noise);

/// For config files, `simulate --noise` and `emulate --noise`: { "lidar": { "noise": ... } }.
/// `with_table`: with the measured ranges, which then count instead of floor and share.
/// `walls`: the paper's model, where it was fitted.
std::string noise_fragment(const calibration::RangeNoise& noise, bool with_table,
                           std::span<const calibration::WallPieceFit> walls);

/// A table of the range's bias at known distances.
std::string describe_distances(std::span<const calibration::KnownWall> walls);
/// A table of the paper's model: pieces and residuals. `distances_known`: given by the user, else
/// fitted.
std::string describe_wall_model(std::span<const calibration::WallPieceFit> fits,
                                bool distances_known);

}  // namespace cornerd::tool
