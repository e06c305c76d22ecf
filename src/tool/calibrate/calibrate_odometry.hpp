// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}

namespace cornerd::tool {

/// cornerctl calibrate odometry.
void add_calibrate_odometry(CLI::App& group);

}  // namespace cornerd::tool
