// SPDX-License-Identifier: MIT
// Fields of the input messages SCAN and ODOMETRY. Internal to src/message.
#pragma once

#include "message/field_reader.hpp"

namespace cornerd::message {

/// Samples are evenly spaced over "duration" if there is no "times".
RecordedScan read_scan(FieldReader& fields);

/// Every field may be absent, including "t".
OdometryReading read_odometry(FieldReader& fields);

}  // namespace cornerd::message
