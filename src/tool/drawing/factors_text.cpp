// SPDX-License-Identifier: MIT
#include "tool/drawing/factors_text.hpp"

#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

std::string describe_factors(calibration::HeadingSource source,
                             const calibration::FoundFactors& found) {
  const std::string encoder =
      formatted("%.3f", found.factors.encoder_factor) + (found.encoder_at_edge ? "*" : "");
  const std::string gyro =
      formatted("%.3f", found.factors.gyro_factor) + (found.gyro_at_edge ? "*" : "");
  if (source == calibration::HeadingSource::kEncoder) return encoder;
  if (source == calibration::HeadingSource::kGyro) return gyro;
  return encoder + ", " + gyro;
}

}  // namespace cornerd::tool
