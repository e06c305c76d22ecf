// SPDX-License-Identifier: MIT
#include "settings/detector_settings.hpp"

namespace cornerd::settings {
namespace {

/// More samples than a turn has make no wall.
constexpr std::uint32_t kMaxCount = 1000;

void read_altbd(ObjectReader altbd, core::AltbdConfig& config) {
  altbd.number("gate_sigmas", config.gate_sigmas, {0.5, 20});
  altbd.integer("seed_samples", config.seed_samples, 3U, kMaxCount);
  altbd.integer("misses_to_break", config.misses_to_break, 1U, kMaxCount);
  altbd.number("max_gap_angle", config.max_gap_rad, {0.001, 3.1416});
  altbd.number("max_gap", config.max_gap_m, {0.001, 10});
  altbd.number("prior_residuals", config.prior_residuals, {1, 1e6});
  altbd.finish();
}

void read_extraction(ObjectReader extraction, core::ExtractionConfig& config) {
  extraction.number("gate_sigmas", config.gate_sigmas, {0.5, 20});
  extraction.integer<std::size_t>("max_interruption", config.max_interruption, 0, kMaxCount);
  extraction.number("max_piece_gap", config.max_piece_gap_m, {0, 10});
  extraction.number("max_piece_angle", config.max_piece_angle_rad, {0.01, 1.57});
  extraction.number("joined_chi_square", config.joined_chi_square, {0, 1e6});
  extraction.integer("doubtful_samples", config.doubtful_samples, 3U, kMaxCount);
  extraction.number("doubtful_sigma", config.doubtful_sigma_rad, {0.001, 1.5});
  extraction.number("min_corner_angle", config.min_corner_angle_rad, {0.01, 1.5});
  extraction.number("grazing_rays", config.grazing_rays, {0, 100});
  extraction.number("grazing_reach", config.grazing_reach, {1, 100});
  extraction.integer<std::size_t>("see_through_samples", config.see_through_samples, 0, kMaxCount);
  extraction.number("see_through_gap", config.see_through_gap_m, {0, 10});
  extraction.number("max_face", config.max_face_m, {0, 1});
  extraction.integer<std::size_t>("min_face_samples", config.min_face_samples, 1, kMaxCount);
  extraction.number("max_end_span", config.max_end_span_m, {0, 1});
  extraction.integer<std::size_t>("look_beyond", config.look_beyond, 2, 100);
  extraction.number("max_rest_sigma", config.max_rest_sigma_rad, {0, 1.5});
  extraction.number("min_rest_angle", config.min_rest_angle_rad, {0, 1.5});
  extraction.number("max_rest_corner_sigma", config.max_rest_corner_sigma_m, {0, 1});
  extraction.finish();
}

}  // namespace

void read_detector(ObjectReader detector, core::DetectorConfig& config) {
  detector.number("sigma_offset", config.sigma_offset, {0.001, 1});
  detector.number("corner_tolerance", config.corner_tolerance_m, {0.001, 10});
  detector.integer("min_support", config.min_support, 3U, kMaxCount);
  read_altbd(detector.object("altbd"), config.altbd);
  read_extraction(detector.object("extraction"), config.extraction);
  detector.finish();
}

}  // namespace cornerd::settings
