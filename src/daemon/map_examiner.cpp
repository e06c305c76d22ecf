// SPDX-License-Identifier: MIT
#include "daemon/map_examiner.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <exception>
#include <vector>

#include "settings/map_file.hpp"

namespace cornerd::daemon {
namespace {

constexpr std::size_t kScans = 16;
/// New scans before the same map is examined again.
constexpr std::size_t kScansBetween = 120;
constexpr int kExaminerNiceness = 19;
/// Of a hundred: in a map whose walls are where it says hardly so many are lost, but for a lidar
/// that is covered or a crowd. The variants decide.
constexpr std::size_t kManyLost = 15;

}  // namespace

void MapExaminer::configure(const settings::Config& config) {
  thread_ = {};
  config_ = config;
  scans_.clear();
  finding_.reset();
  map_ = nullptr;
  added_ = 0;
}

void MapExaminer::observe(const ScanReport& report) {
  const core::Scan& scan = report.scan;
  if (scan.start_ns() - newest_ns_ < core::kNsPerSecond && scan.start_ns() > newest_ns_) return;
  newest_ns_ = scan.start_ns();
  if (scans_.size() == kScans) scans_.pop_front();
  scans_.emplace_back(scan.samples().begin(), scan.samples().end());
  ++added_;
}

const std::optional<calibration::MapFinding>& MapExaminer::update(std::size_t lost,
                                                                  const core::WallMap* map) {
  if (is_done_.load(std::memory_order_acquire)) {
    thread_.join();
    is_done_.store(false, std::memory_order_relaxed);
    finding_ = result_;
  }
  const bool is_many = lost >= kManyLost;
  if (!is_many || map != map_) finding_.reset();
  const bool is_due = map != map_ || added_ >= kScansBetween;
  if (is_many && map != nullptr && is_due && scans_.size() == kScans && !thread_.joinable()) {
    map_ = map;
    added_ = 0;
    examined_.assign(scans_.begin(), scans_.end());
    thread_ = std::jthread(
        [this, plan = map->plan()](const std::stop_token& stop) { examine(plan, stop); });
  }
  return finding_;
}

void MapExaminer::examine(const core::FloorPlan& plan, const std::stop_token& stop) {
  ::pthread_setname_np(::pthread_self(), "map-examiner");
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kExaminerNiceness);
  result_.reset();
  try {
    std::vector<core::FloorPlan> others;
    for (const settings::NamedMap& other : config_.maps) {
      if (other.name == plan.name) continue;
      others.push_back(settings::load_map(other.file)->plan());
      others.back().name = other.name;
    }
    result_ = calibration::find_map_fault(plan, others, config_.localizer(), examined_,
                                          [&] { return stop.stop_requested(); });
  } catch (const std::exception&) {
    // A map that cannot be read is the reload's to name; memory may lack for the variants.
  }
  is_done_.store(true, std::memory_order_release);
}

}  // namespace cornerd::daemon
