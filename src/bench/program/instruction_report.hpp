// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "bench/methods.hpp"
#include "bench/program/report.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::bench {

/// What the turns are made of.
struct CountedScans {
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  std::filesystem::path folder;  ///< of the maps
  replay::SensorModel sensor;
  std::uint64_t seed = 0;
};

/// Fills in the instructions that each method takes for a turn, for several numbers of samples: by
/// the processor's counter, else by valgrind as the difference between detecting once and twice,
/// so that nothing but the detection counts. Where there is neither, says so on standard error.
void count_instructions(const CountedScans& scans, std::span<const NamedMethod> methods,
                        BenchReport& report);

}  // namespace cornerd::bench
