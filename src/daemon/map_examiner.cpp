// SPDX-License-Identifier: MIT
#include "daemon/map_examiner.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <exception>
#include <vector>

#include "settings/map_examination.hpp"

namespace cornerd::daemon {
namespace {

/// New scans before the same map is examined again.
constexpr std::size_t kScansBetween = 120;
constexpr int kExaminerNiceness = 19;

}  // namespace

void MapExaminer::configure(const settings::Config& config) {
  thread_ = {};
  // What the thread has found concerns the map before; and update() joins it where it is done.
  is_done_.store(false, std::memory_order_relaxed);
  config_ = config;
  scans_ = {};
  finding_.reset();
  map_ = nullptr;
  added_ = 0;
}

void MapExaminer::observe(const ScanReport& report) {
  if (scans_.add(report.scan)) ++added_;
}

const std::optional<calibration::MapFinding>& MapExaminer::update(bool is_doubtful,
                                                                  const core::WallMap* map) {
  if (is_done_.load(std::memory_order_acquire)) {
    thread_.join();
    is_done_.store(false, std::memory_order_relaxed);
    finding_ = result_;
  }
  if (!is_doubtful || map != map_) finding_.reset();
  const bool is_due = map != map_ || added_ >= kScansBetween;
  if (is_doubtful && map != nullptr && is_due && scans_.are_enough() && !thread_.joinable()) {
    map_ = map;
    added_ = 0;
    examined_ = scans_.all();
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
    result_ =
        settings::examine_map(plan, config_, examined_, [&] { return stop.stop_requested(); });
  } catch (const std::exception&) {
    // A map that cannot be read is the reload's to name; memory may lack for the variants.
  }
  is_done_.store(true, std::memory_order_release);
}

}  // namespace cornerd::daemon
