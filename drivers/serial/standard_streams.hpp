// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::drivers {

/// Gives the descriptors 0 to 2 to /dev/null where they are closed. A port or a socket that is
/// opened in their place would be told the log.
void occupy_standard_streams();

}  // namespace cornerd::drivers
