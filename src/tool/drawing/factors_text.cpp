// SPDX-License-Identifier: MIT
#include "tool/drawing/factors_text.hpp"

#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

std::string describe_factors(core::HeadingSource source, const calibration::FoundFactors& found) {
  const std::string encoder =
      formatted("%.3f", found.factors.encoder_factor) + (found.encoder_at_edge ? "*" : "");
  const std::string gyro =
      formatted("%.3f", found.factors.gyro_factor) + (found.gyro_at_edge ? "*" : "");
  if (source == core::HeadingSource::kEncoder) return encoder;
  if (source == core::HeadingSource::kGyro) return gyro;
  return encoder + ", " + gyro;
}

}  // namespace cornerd::tool
