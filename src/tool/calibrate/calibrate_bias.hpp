// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace cornerd::tool {

/// The command `bias` of the group.
void add_calibrate_bias(CLI::App& group);

}  // namespace cornerd::tool
