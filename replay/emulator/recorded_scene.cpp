// SPDX-License-Identifier: MIT
#include "replay/emulator/recorded_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cornerd::replay {
namespace {

/// About half of an A1's widest step (2 kHz at 10 Hz: 1.8 degrees); farther away is a gap.
constexpr double kMaxSampleDistanceRad = core::radians(1.0);

}  // namespace

/// Collects the scans that a step of the player has completed.
class RecordedScene::ScanCollector : public RecordingSink {
 public:
  void on_sample(const core::Sample& sample) override {
    if (assembler_.add(sample, scan_)) keep();
  }
  void on_gap() override { finish(); }
  void on_odometry(const message::OdometryReading&) override {}

  void finish() {
    if (assembler_.finish(scan_)) keep();
  }

  std::deque<std::vector<Return>> scans;

 private:
  void keep() {
    std::vector<Return>& returns = scans.emplace_back();
    returns.reserve(scan_.size());
    for (const core::Sample& sample : scan_.samples()) {
      returns.push_back({sample.bearing_rad, sample.range_m});
    }
    std::sort(returns.begin(), returns.end(),
              [](const Return& a, const Return& b) { return a.bearing_rad < b.bearing_rad; });
  }

  core::ScanAssembler assembler_;
  core::Scan scan_;
};

RecordedScene::RecordedScene(std::filesystem::path file, const RecordingOptions& options)
    : file_(std::move(file)), options_(options) {
  open();
  load_next_scan();
}

RecordedScene::~RecordedScene() = default;

void RecordedScene::open() {
  player_ = std::make_unique<RecordingPlayer>(file_, options_);
  scans_ = std::make_unique<ScanCollector>();
}

void RecordedScene::load_next_scan() {
  bool restarted = false;
  while (scans_->scans.empty()) {
    if (player_->step(*scans_)) continue;
    scans_->finish();
    if (!scans_->scans.empty()) break;
    if (restarted) throw RecordingError(file_.string() + ": no complete scan; record for longer");
    restarted = true;
    open();
  }
  returns_ = std::move(scans_->scans.front());
  scans_->scans.pop_front();
}

double RecordedScene::nearest_range(double bearing_rad) const {
  const double bearing = core::normalize_angle(bearing_rad);
  const auto after =
      std::lower_bound(returns_.begin(), returns_.end(), bearing,
                       [](const Return& entry, double value) { return entry.bearing_rad < value; });
  const Return& next = after == returns_.end() ? returns_.front() : *after;
  const Return& previous = after == returns_.begin() ? returns_.back() : *(after - 1);
  const double to_next = std::abs(core::angle_between(bearing, next.bearing_rad));
  const double to_previous = std::abs(core::angle_between(bearing, previous.bearing_rad));
  if (std::min(to_next, to_previous) > kMaxSampleDistanceRad) return 0;
  return to_next < to_previous ? next.range_m : previous.range_m;
}

double RecordedScene::range_along(core::TimeNs, std::int64_t scan, const core::Vec2& origin,
                                  double bearing_rad) {
  if (scan > scan_) {
    scan_ = scan;
    load_next_scan();
  }
  // A ray offset from the axis hits a point of range r at bearing + asin(left / r): iterate.
  const double left_m = core::cross(core::unit_vector(bearing_rad), origin);
  double range_m = nearest_range(bearing_rad);
  for (int i = 0; i < 3 && range_m > std::abs(left_m); ++i) {
    range_m = nearest_range(bearing_rad + std::asin(left_m / range_m));
  }
  if (range_m <= std::abs(left_m)) return 0;
  return std::sqrt(range_m * range_m - left_m * left_m) -
         core::unit_vector(bearing_rad).dot(origin);
}

}  // namespace cornerd::replay
