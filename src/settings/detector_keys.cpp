// SPDX-License-Identifier: MIT
#include <string>

#include "settings/config_table.hpp"

namespace cornerd::settings {
namespace {

/// More samples than a scan has.
constexpr std::uint32_t kMaxCount = 1000;

}  // namespace

void add_detector_keys(std::vector<Key>& table, core::DetectorConfig& config) {
  std::string section = "/advanced/detector";
  const auto add = [&](const char* name, Value value, const char* text, std::string old = {}) {
    if (!old.empty()) old.insert(0, "/detector/extraction/");
    table.push_back({section + name, std::move(value), text, Applies::kOnReload, std::move(old)});
  };
  add("", {},
      "How corners are found. \"The paper\" is El Amin, Priandana and Hardhienata's of ALTBD. A "
      "default without a source is the best one in `cornerd-bench`.");
  add("/sigma_offset", number(config.sigma_offset, 0.001, 1),
      "Deviation of a sample from its wall, as a share of its range, that is still the wall "
      "(paper, "
      "step 5, section V.C).");
  add("/corner_tolerance", number(config.corner_tolerance_m, 0.001, 10),
      "Two ends of walls that are nearer than this are one corner, metres: half a door (paper, "
      "step "
      "13).");
  add("/min_support", integer(config.min_support, 3, kMaxCount),
      "Samples that make a wall. The paper has \"more than four points\" (section V.B); four find "
      "more of the corners.");

  section = "/advanced/detector/altbd";
  core::AltbdConfig& altbd = config.altbd;
  add("/gate_sigmas", number(altbd.gate_sigmas, 0.5, 20),
      "Half axes of the ellipse, in standard deviations of the residual.");
  add("/seed_samples", integer(altbd.seed_samples, 3, kMaxCount),
      "Samples that start a line (paper, step 1).");
  add("/misses_to_break", integer(altbd.misses_to_break, 1, kMaxCount),
      "Misses in a row that end a line.");
  add("/max_gap_angle", number(altbd.max_gap_rad, 0.001, 3.1416),
      "No wall is followed over a larger step between bearings, radians.");
  add("/max_gap", number(altbd.max_gap_m, 0.001, 10),
      "No wall is followed over a larger step along it, metres: less than a door.");
  add("/prior_residuals", number(altbd.prior_residuals, 1, 1e6),
      "Weight of /lidar/noise, in residuals, where the noise of a scan is estimated.");

  section = "/advanced/detector/extraction";
  core::ExtractionConfig& extraction = config.extraction;
  add("", {}, "From walls to corners and wall ends.");
  add("/gate_sigmas", number(extraction.gate_sigmas, 0.5, 20),
      "Deviation, in standard deviations, that is still noise.");
  add("/max_interruption", integer(extraction.max_interruption, 0, kMaxCount),
      "Samples between two segments that may be merged into one wall.");
  add("/merge_gap", number(extraction.merge_gap_m, 0, 10), "Largest gap between them, metres.",
      "max_piece_gap");
  add("/merge_angle", number(extraction.merge_angle_rad, 0.01, 1.57),
      "Largest angle between them, radians.", "max_piece_angle");
  add("/merge_chi_square", number(extraction.merge_chi_square, 0, 1e6),
      "Largest chi-square that one line instead of two may cost.", "joined_chi_square");
  add("/short_wall_samples", integer(extraction.short_wall_samples, 3, kMaxCount),
      "A wall of at most so many samples may be noise of its neighbours and is tested for it.",
      "doubtful_samples");
  add("/short_wall_sigma", number(extraction.short_wall_sigma_rad, 0.001, 1.5),
      "So may a wall whose direction has a larger sigma, radians.", "doubtful_sigma");
  add("/min_corner_angle", number(extraction.min_corner_angle_rad, 0.01, 1.5),
      "Smallest angle of a corner, radians.");
  add("/grazing_rays", number(extraction.grazing_rays, 0, 100),
      "Rays without a return that are allowed between a grazed wall and its corner.");
  add("/grazing_gap", number(extraction.grazing_gap, 1, 100),
      "Largest gap that they may leave, in units of corner_tolerance.", "grazing_reach");
  add("/see_through_samples", integer(extraction.see_through_samples, 0, kMaxCount),
      "Behind a corner one sample is an outlier where more samples than these lie between the "
      "corner's walls.");
  add("/see_through_gap", number(extraction.see_through_gap_m, 0, 10),
      "The same where those walls are nearer to each other than this, metres.");
  add("/max_face", number(extraction.max_face_m, 0, 1),
      "Depth of the face of a wall's end that shows its corner, metres.");
  add("/min_face_samples", integer(extraction.min_face_samples, 1, kMaxCount),
      "Samples on that face.");
  add("/max_end_span", number(extraction.max_end_span_m, 0, 1),
      "A wall whose end is known less exactly than this reports no end, metres.");
  add("/occlusion_samples", integer(extraction.occlusion_samples, 2, 100),
      "Samples beyond an end that are tested for occlusion by the wall; two must be occluded.",
      "look_beyond");
  add("/stub_sigma", number(extraction.stub_sigma_rad, 0, 1.5),
      "Two to four samples beside a corner show its other wall. Largest sigma of their direction, "
      "radians.",
      "max_rest_sigma");
  add("/stub_angle", number(extraction.stub_angle_rad, 0, 1.5),
      "Smallest angle between such a wall and the rays, radians.", "min_rest_angle");
  add("/stub_corner_sigma", number(extraction.stub_corner_sigma_m, 0, 1),
      "Largest sigma of such a corner, metres.", "max_rest_corner_sigma");
}

}  // namespace cornerd::settings
