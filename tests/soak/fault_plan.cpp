// SPDX-License-Identifier: MIT
#include "fault_plan.hpp"

#include <cstdio>

namespace cornerd::soak {

FaultPlan::FaultPlan(replay::EmulatedDevice& device, replay::CoverableScene& scene,
                     const FaultConfig& config, std::uint64_t seed)
    : device_(device), scene_(scene), config_(config), random_(seed) {}

void FaultPlan::advance(core::TimeNs now_ns) {
  if (now_ns < next_ns_) return;
  is_on_ ? end(now_ns) : begin(now_ns);
}

void FaultPlan::begin(core::TimeNs now_ns) {
  is_on_ = true;
  next_ns_ = now_ns + core::from_seconds(random_.uniform(0.001, config_.max_duration_s));
  replay::StreamFaults& faults = device_.faults();
  const std::size_t any = random_.bits() % kNames.size();
  const std::size_t kind = config_.only.value_or(any);
  ++counts_[kind];
  {
    const std::lock_guard lock(mutex_);
    faults_[begun_++ % faults_.size()] = {kind, now_ns, 0};
  }
  switch (kind) {
    case 0:
      faults.damaged_share = random_.chance(0.5) ? 0.001 : 0.05;
      break;
    case 1:
      faults.to_lose = 1 + random_.bits() % 3000;
      break;
    case 2:
      faults.to_repeat = 1 + random_.bits() % 300;
      break;
    case 3:
      faults.to_insert = 1 + random_.bits() % 3000;
      break;
    case 4:
      device_.plug(false);
      break;
    case 5:
      device_.emulator().set_stalled(true, now_ns);
      break;
    case 6:
      device_.emulator().set_health({.status = 2, .code = 0x8001}, now_ns);
      break;
    case 7:
      scene_.cover(true);
      break;
    case 8:
      device_.emulator().power_cycle(now_ns);
      break;
    case 9:
      // Loses one second of bytes.
      device_.faults().to_lose = 11'520;
      break;
    default:
      break;
  }
}

void FaultPlan::end(core::TimeNs now_ns) {
  is_on_ = false;
  {
    const std::lock_guard lock(mutex_);
    faults_[(begun_ - 1) % faults_.size()].end_ns = now_ns;
  }
  next_ns_ = now_ns + core::from_seconds(random_.uniform(0, 2 * config_.mean_pause_s));
  device_.faults().damaged_share = 0;
  device_.faults().to_lose = 0;
  device_.plug(true);
  device_.emulator().set_stalled(false, now_ns);
  scene_.cover(false);
}

std::string FaultPlan::at(core::TimeNs t_ns) const {
  const std::lock_guard lock(mutex_);
  for (std::uint64_t i = begun_; i > 0 && begun_ - i < faults_.size(); --i) {
    const Fault& fault = faults_[(i - 1) % faults_.size()];
    if (fault.begin_ns > t_ns) continue;
    char text[96];
    std::snprintf(text, sizeof(text), "%.2f s after \"%s\" began",
                  core::to_seconds(t_ns - fault.begin_ns), kNames[fault.kind].data());
    std::string description = text;
    if (fault.end_ns == 0 || fault.end_ns > t_ns) return description;
    std::snprintf(text, sizeof(text), ", %.2f s after its end",
                  core::to_seconds(t_ns - fault.end_ns));
    return description + text;
  }
  return "before the first fault";
}

}  // namespace cornerd::soak
