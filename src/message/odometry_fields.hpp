// SPDX-License-Identifier: MIT
#pragma once

#include "message/field_reader.hpp"

namespace cornerd::message {

/// ODOMETRY: every field may be absent, even t.
OdometryReading read_odometry(FieldReader& fields);

}  // namespace cornerd::message
