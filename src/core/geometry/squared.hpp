// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::core {

constexpr double squared(double value) { return value * value; }

}  // namespace cornerd::core
