// SPDX-License-Identifier: MIT
// What one turn showed: SCAN and BREAKPOINTS of LineWriter.
#include <cmath>

#include "core/breakpoint/breakpoint.hpp"
#include "core/scan.hpp"
#include "message/line.hpp"
#include "message/place_text.hpp"
#include "message/state_names.hpp"

namespace cornerd::message {
namespace {

/// A sample's offset from SCAN.t where the samples are spread evenly: the turn lasts one sample
/// period longer than from its first sample to its last.
double even_offset_s(double duration_s, std::size_t index, std::size_t count) {
  return duration_s * static_cast<double>(index) / static_cast<double>(count);
}

double duration_of(const core::Scan& scan) {
  if (scan.size() < 2) return 0;
  const double first_to_last_s = core::to_seconds(scan.end_ns() - scan.start_ns());
  return first_to_last_s * static_cast<double>(scan.size()) / static_cast<double>(scan.size() - 1);
}

bool is_spread_evenly(const core::Scan& scan, double duration_s) {
  const auto samples = scan.samples();
  const double half_period_s = duration_s / static_cast<double>(scan.size()) / 2;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double offset_s = core::to_seconds(samples[i].t_ns - scan.start_ns());
    if (std::abs(offset_s - even_offset_s(duration_s, i, samples.size())) > half_period_s) {
      return false;
    }
  }
  return true;
}

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0; }

/// `write`: called with each sample.
void write_samples(JsonText& json, std::string_view name, const core::Scan& scan,
                   const auto& write) {
  json.open_array(name);
  for (const core::Sample& sample : scan.samples()) write(sample);
  json.close_array();
}

void write_wall(JsonText& json, std::string_view wall, double bearing_rad, std::string_view support,
                int samples) {
  write_angle(json, wall, bearing_rad);
  json.integer(support, samples);
}

void write_breakpoint(JsonText& json, const core::Breakpoint& point) {
  json.open_object();
  write_metres(json, "x", point.position.x());
  write_metres(json, "y", point.position.y());
  json.string("kind", to_string(point.kind));
  if (point.kind == core::BreakpointKind::kCorner && std::isfinite(point.opening_rad)) {
    // An opening runs to 2 pi, so it is no direction to be brought into (-pi, pi].
    json.number("angle", point.opening_rad, 6);
    json.boolean("convex", point.convex);
  }
  if (point.wall_on_right) {
    write_wall(json, "right_wall", point.right_wall_rad, "right_support", point.right_support);
  }
  if (point.wall_on_left) {
    write_wall(json, "left_wall", point.left_wall_rad, "left_support", point.left_support);
  }
  if (point.covariance.allFinite()) {
    json.open_object("cov");
    json.significant("xx", point.covariance(0, 0));
    json.significant("xy", point.covariance(0, 1));
    json.significant("yy", point.covariance(1, 1));
    json.close_object();
  }
  json.close_object();
}

}  // namespace

std::string_view LineWriter::scan(const core::Scan& scan) {
  const double duration_s = duration_of(scan);
  begin("SCAN");
  json_.seconds("t", scan.start_ns());
  json_.key("duration");
  json_.fixed(duration_s, kTimeDecimals);
  write_samples(json_, "angles", scan, [this](const core::Sample& sample) {
    json_.angle(finite_or_zero(sample.bearing_rad));
  });
  write_samples(json_, "ranges", scan, [this](const core::Sample& sample) {
    json_.fixed(finite_or_zero(sample.range_m), kMetreDecimals);
  });
  write_samples(json_, "quality", scan, [this](const core::Sample& sample) {
    json_.integer(static_cast<unsigned>(sample.quality));
  });
  if (!is_spread_evenly(scan, duration_s)) {
    write_samples(json_, "times", scan, [this, &scan](const core::Sample& sample) {
      json_.fixed(core::to_seconds(sample.t_ns - scan.start_ns()), kTimeDecimals);
    });
  }
  return finish();
}

std::string_view LineWriter::breakpoints(core::TimeNs t_ns, const core::Detection& detection) {
  begin("BREAKPOINTS");
  json_.seconds("t", t_ns);
  json_.open_array("points");
  for (const core::Breakpoint& point : detection.breakpoints) write_breakpoint(json_, point);
  json_.close_array();
  return finish();
}

}  // namespace cornerd::message
