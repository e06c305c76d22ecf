// SPDX-License-Identifier: MIT
#include <algorithm>

#include "bench/floors_experiment.hpp"
#include "bench/program/benches.hpp"
#include "bench/statistics.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/progress_bar.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {
namespace {

/// The first set shows whether a map is ever named wrongly: the others get fewer drives.
constexpr std::size_t kFewer = 10;

/// "8 / 24 / 60": median, 90 % and maximum.
std::string quantiles(std::vector<double> values) {
  if (values.empty()) return "-";
  std::sort(values.begin(), values.end());
  std::string text;
  for (const double share : {0.5, 0.9, 1.0}) {
    text += (text.empty() ? "" : " / ") + tool::formatted("%.0f", quantile(values, share));
  }
  return text;
}

}  // namespace

void run_floors_bench(std::size_t floors, std::uint64_t seed) {
  tool::TextTable table;
  table.add_row({"maps", "starts", "right", "wrong", "ambiguous", "without truth", "none",
                 "scans until named", "metres", "poses", "lost", "wrong"});
  std::size_t starts = floors;
  for (const MapSet& set : map_sets(seed)) {
    tool::ProgressBar bar(set.title, starts);
    const FloorScore score =
        run_map_set(set, starts, seed, [&](std::size_t done) { bar.show(done); });
    std::vector<std::string> row = {set.title};
    for (const std::size_t count : {score.starts, score.right, score.wrong, score.ambiguous,
                                    score.without_truth, score.none}) {
      row.push_back(std::to_string(count));
    }
    row.push_back(quantiles(score.scans));
    row.push_back(quantiles(score.driven_m));
    for (const std::size_t count : {score.poses, score.lost_poses, score.wrong_poses}) {
      row.push_back(std::to_string(count));
    }
    table.add_row(row);
    starts = std::max<std::size_t>(1, floors / kFewer);
  }
  tool::Output output;
  output.write(
      "Which map a drive is in; median / 90 % / maximum of scans and metres until it is "
      "named\n\n" +
      table.text(/*numbers=*/true));
  output.flush();
}

}  // namespace cornerd::bench
