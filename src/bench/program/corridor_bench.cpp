// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <vector>

#include "bench/building.hpp"
#include "bench/corridor_experiment.hpp"
#include "bench/program/benches.hpp"
#include "tool/command_line/output.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {
namespace {

constexpr std::size_t kCorridorScans = 800;
struct CorridorRow {
  CorridorRobot robot;
  const char* title;
};
constexpr CorridorRow kCorridorRows[] = {{CorridorRobot::kLidarAlone, "lidar alone"},
                                         {CorridorRobot::kWheels, "wheels"},
                                         {CorridorRobot::kWheelsAndGyro, "wheels and gyro"}};

}  // namespace

void run_corridor_bench(std::size_t corridors, std::uint64_t seed) {
  tool::TextTable table;
  table.add_row({"robot", "scans", "named", "predicted", "ambiguous", "lost", "wrong",
                 "drives with wrong ones"});
  for (const CorridorRow& row : kCorridorRows) {
    std::size_t sums[6] = {};
    std::size_t wrong_drives = 0;
    for (std::uint64_t k = seed; k < seed + corridors; ++k) {
      const auto corridor = std::make_shared<const core::WallMap>(long_corridor(k));
      const PoseScore score = drive_along(corridor, row.robot, kCorridorScans, k);
      const std::size_t counts[6] = {score.scans(),     score.named(), score.predicted(),
                                     score.ambiguous(), score.lost(),  score.wrong()};
      for (std::size_t i = 0; i < 6; ++i) sums[i] += counts[i];
      wrong_drives += score.wrong() > 0 ? 1 : 0;
    }
    std::vector<std::string> cells = {row.title};
    for (const std::size_t sum : sums) cells.push_back(std::to_string(sum));
    cells.push_back(std::to_string(wrong_drives) + " of " + std::to_string(corridors));
    table.add_row(cells);
  }
  tool::Output output;
  output.write(table.text());
  output.flush();
}

}  // namespace cornerd::bench
