// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "web/hub.hpp"

namespace cornerd::web {

/// What the hub holds, in Prometheus' text format 0.0.4.
std::string metrics_text(const Hub& hub);

}  // namespace cornerd::web
