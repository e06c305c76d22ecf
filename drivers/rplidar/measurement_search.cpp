// SPDX-License-Identifier: MIT
#include "drivers/rplidar/measurement_search.hpp"

namespace cornerd::rplidar {

void MeasurementSearch::on_sample(const RawSample& /*sample*/) { found_ = true; }

}  // namespace cornerd::rplidar
