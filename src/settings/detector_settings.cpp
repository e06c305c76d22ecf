// SPDX-License-Identifier: MIT
#include "settings/detector_settings.hpp"

namespace cornerd::settings {
namespace {

constexpr Choice<core::Method> kMethods[] = {{"altbd", core::Method::kAltbd},
                                             {"altbd-printed", core::Method::kPrintedAltbd},
                                             {"abd-iepf", core::Method::kAbdIepf},
                                             {"lt", core::Method::kLineTracking}};
constexpr Choice<core::EllipseAxes> kAxes[] = {{"printed", core::EllipseAxes::kPrinted},
                                               {"squared", core::EllipseAxes::kSquared}};
constexpr Choice<core::MinorAxis> kMinorAxes[] = {{"metres", core::MinorAxis::kMetres},
                                                  {"share", core::MinorAxis::kShareOfRange}};
constexpr Choice<core::TrackedLine> kLines[] = {{"first-three", core::TrackedLine::kFirstThree},
                                                {"last-three", core::TrackedLine::kLastThree},
                                                {"all", core::TrackedLine::kAll}};
constexpr Choice<core::ErrorMean> kMeans[] = {{"last-three", core::ErrorMean::kLastThree},
                                              {"all", core::ErrorMean::kAll}};
constexpr Choice<core::AbdThreshold> kThresholds[] = {
    {"borges-aldon", core::AbdThreshold::kBorgesAldon},
    {"weerakoon", core::AbdThreshold::kWeerakoon}};

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

void read_printed_altbd(ObjectReader printed, core::PrintedAltbdConfig& config) {
  printed.choice("axes", config.axes, kAxes);
  printed.choice("minor_axis", config.minor, kMinorAxes);
  printed.choice("line", config.line, kLines);
  printed.choice("mean", config.mean, kMeans);
  printed.finish();
}

void read_abd_iepf(ObjectReader abd_iepf, core::AbdIepfConfig& config) {
  abd_iepf.choice("threshold", config.threshold, kThresholds);
  abd_iepf.number("sigma_r", config.sigma_r, {0, 0.3});
  abd_iepf.number("lambda", config.lambda_rad, {0.001, 1.5});
  abd_iepf.number("split_limit", config.split_limit_m, {0.0001, 10});
  abd_iepf.finish();
}

void read_extraction(ObjectReader extraction, core::ExtractionConfig& config) {
  extraction.number("gate_sigmas", config.gate_sigmas, {0.5, 20});
  extraction.integer<std::size_t>("max_interruption", config.max_interruption, 0, kMaxCount);
  extraction.number("max_piece_gap", config.max_piece_gap_m, {0, 10});
  extraction.number("max_piece_angle", config.max_piece_angle_rad, {0.01, 1.57});
  extraction.number("joined_chi_square", config.joined_chi_square, {0, 1e6});
  extraction.integer("doubtful_samples", config.short_wall_samples, 3U, kMaxCount);
  extraction.number("doubtful_sigma", config.short_wall_sigma_rad, {0.001, 1.5});
  extraction.number("min_corner_angle", config.min_corner_angle_rad, {0.01, 1.5});
  extraction.number("grazing_rays", config.grazing_rays, {0, 100});
  extraction.number("grazing_reach", config.grazing_reach, {1, 100});
  extraction.integer<std::size_t>("see_through_samples", config.see_through_samples, 0, kMaxCount);
  extraction.number("see_through_gap", config.see_through_gap_m, {0, 10});
  extraction.number("max_face", config.max_face_m, {0, 1});
  extraction.integer<std::size_t>("min_face_samples", config.min_face_samples, 1, kMaxCount);
  extraction.number("max_end_span", config.max_end_span_m, {0, 1});
  extraction.integer<std::size_t>("look_beyond", config.samples_beyond, 2, 100);
  extraction.number("max_rest_sigma", config.max_rest_sigma_rad, {0, 1.5});
  extraction.number("min_rest_angle", config.min_rest_angle_rad, {0, 1.5});
  extraction.number("max_rest_corner_sigma", config.max_rest_corner_sigma_m, {0, 1});
  extraction.finish();
}

}  // namespace

void read_detector(ObjectReader detector, core::DetectorConfig& config) {
  detector.choice("method", config.method, kMethods);
  detector.number("sigma_offset", config.sigma_offset, {0.001, 1});
  detector.number("corner_tolerance", config.corner_tolerance_m, {0.001, 10});
  detector.integer("min_support", config.min_support, 3U, kMaxCount);
  read_altbd(detector.object("altbd"), config.altbd);
  read_printed_altbd(detector.object("printed_altbd"), config.printed_altbd);
  read_abd_iepf(detector.object("abd_iepf"), config.abd_iepf);
  ObjectReader lt = detector.object("lt");
  lt.number("max_distance", config.lt.max_distance_m, {0.0001, 10});
  lt.finish();
  read_extraction(detector.object("extraction"), config.extraction);
  detector.finish();
}

}  // namespace cornerd::settings
