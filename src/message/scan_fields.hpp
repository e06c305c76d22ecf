// SPDX-License-Identifier: MIT
#pragma once

#include "message/field_reader.hpp"

namespace cornerd::message {

/// SCAN, its samples spread evenly where it gives no times.
RecordedScan read_scan(FieldReader& fields);

}  // namespace cornerd::message
