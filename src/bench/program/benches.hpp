// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cornerd::bench {

/// Where --instructions cannot be done.
inline constexpr const char* kNotCounted =
    "cornerd-bench: instructions are not counted: no performance counter for this user, and no "
    "valgrind; install valgrind\n";

struct LocalizationBenchOptions {
  std::filesystem::path maps;  ///< folder of the contest arena's layouts and of flat-7.json
  std::size_t poses = 1000;    ///< in each trial
  std::uint64_t seed = 1;
  bool instructions = false;
  std::string json;  ///< file, "-" or empty
};

/// cornerd-bench --localizer: accuracy, consistency, disturbances, motion, kidnapping and cost.
void run_localization_bench(const LocalizationBenchOptions& options);

/// The workload for valgrind: localizes `scans` scans without output. `tracking`: with the previous
/// scan as the prior, else without.
void only_localize_in_arena(const LocalizationBenchOptions& options, std::size_t scans,
                            bool tracking);

struct EvidenceBenchOptions {
  std::filesystem::path maps;  ///< folder of the contest arena's layouts and of flat-7.json
  std::filesystem::path file;
  std::size_t scans = 16'000;
  std::uint64_t seed = 1;
};

/// cornerd-bench --evidence: what the rays of random scans do at right and wrong places, as CSV.
void run_evidence_bench(const EvidenceBenchOptions& options);

struct OdometryBenchOptions {
  std::filesystem::path maps;   ///< folder with flat-7.json; empty: the installed one
  std::filesystem::path plots;  ///< folder; empty: no drawings
  std::string json;             ///< file, "-" or empty
  std::uint64_t seed = 1;
  std::size_t drives = 4;  ///< of each robot whose lidar is covered periodically
  std::size_t robots = 0;  ///< drawn at random
};

/// cornerd-bench --odometry: the paper's odometry modes on its drives, as a table, as JSON and
/// drawn with the truth.
void run_odometry_bench(const OdometryBenchOptions& options);

/// cornerd-bench --odometry --robots N: drives of robots, sensors and faults drawn at random.
void run_random_robot_bench(const OdometryBenchOptions& options);

/// cornerd-bench --floors: which of ten maps a drive is in, where they are floors of one building;
/// a tenth as many drives where these are furnished, where two are the same, and in flats.
void run_floors_bench(std::size_t floors, std::uint64_t seed);

struct ScaleBenchOptions {
  std::vector<std::size_t> corners = {20, 200, 2000, 20'000};
  std::size_t scans = 200;
  std::uint64_t seed = 1;
  bool instructions = false;
  std::filesystem::path plots;  ///< folder; empty: no drawing
  std::string json;             ///< file, "-" or empty
};

/// cornerd-bench --scale: the first fix in buildings of several sizes, as a table, as JSON and as
/// a drawing.
void run_scale_bench(const ScaleBenchOptions& options);

/// The workload for valgrind: localizes each scan `times` without output.
void only_localize(const ScaleBenchOptions& options, std::size_t times);

struct DrawnPlanBenchOptions {
  std::filesystem::path maps;  ///< folder of the contest arena's layouts and of flat-7.json
  std::size_t plans = 8;       ///< of each building
  std::uint64_t seed = 1;
};

/// cornerd-bench --drawn-plans: drives in maps with errors of a plan drawn by hand, with and
/// without learning the walls' offsets, as a table.
void run_drawn_plan_bench(const DrawnPlanBenchOptions& options);

/// cornerd-bench --corridors: drives along so many corridors drawn at random, as a table.
void run_corridor_bench(std::size_t corridors, std::uint64_t seed);

struct SurveyBenchOptions {
  std::filesystem::path maps;   ///< folder with flat-7.json
  std::filesystem::path plots;  ///< folder; empty: no drawings
  std::uint64_t seed = 1;
};

/// cornerd-bench --survey: a simulated drive of 100 m, surveyed by both methods, as a table.
void run_survey_bench(const SurveyBenchOptions& options);

}  // namespace cornerd::bench
