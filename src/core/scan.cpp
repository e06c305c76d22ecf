// SPDX-License-Identifier: MIT
#include "core/scan.hpp"

#include <cmath>
#include <utility>

#include "core/geometry/angle.hpp"

namespace cornerd::core {
namespace {

/// Rotation of the head from the first to the last sample, in either direction.
double swept_rad(std::span<const Sample> samples) {
  double swept = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    swept += angle_between(samples[i - 1].bearing_rad, samples[i].bearing_rad);
  }
  return std::abs(swept);
}

}  // namespace

void Scan::assign_reversed(const Scan& other) {
  samples_.assign(other.samples_.rbegin(), other.samples_.rend());
  for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i].t_ns = other.samples_[i].t_ns;
}

bool ScanAssembler::add(const Sample& sample, Scan& scan) {
  bool completed = false;
  if (sample.starts_scan) {
    completed = collects_ && !collecting_.empty();
    if (completed) std::swap(collecting_, scan);
    collecting_.clear();
    collects_ = true;
  }
  if (!collects_ || !collecting_.add(sample)) ++dropped_;
  if (sample.ends_scan && collects_ && !completed) {
    std::swap(collecting_, scan);
    collecting_.clear();
    collects_ = false;
    completed = true;
  }
  return completed;
}

bool ScanAssembler::finish(Scan& scan) {
  constexpr double kFullRevolution_rad = radians(350);
  const bool whole = collects_ && swept_rad(collecting_.samples()) >= kFullRevolution_rad;
  if (whole) {
    std::swap(collecting_, scan);
  } else {
    dropped_ += collecting_.size();
  }
  collecting_.clear();
  collects_ = false;
  return whole;
}

void ScanAssembler::reset() {
  dropped_ += collecting_.size();
  collecting_.clear();
  collects_ = false;
}

}  // namespace cornerd::core
