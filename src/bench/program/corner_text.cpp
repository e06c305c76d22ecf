// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "bench/program/report.hpp"
#include "bench/statistics.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

std::string corner_tables(const BenchReport& report) {
  constexpr double kMm = 1e3;
  std::string out = "Corners at " + std::to_string(report.positions) + " random poses\n\n";
  for (const CornerReport& corners : report.corners) {
    tool::TextTable table;
    table.add_row({"method", "precision", "strict", "of corners", "strict", "recall 5", "recall 1",
                   "median mm", "95 % mm", "false"});
    for (const MethodScore& line : corners.scores) {
      const CornerScore& score = line.score;
      std::vector<double> errors_m = score.errors_m();
      std::sort(errors_m.begin(), errors_m.end());
      const auto scans = static_cast<double>(std::max<std::size_t>(score.scans(), 1));
      const auto false_count = static_cast<double>(score.detections(Verdict::kFalse));
      table.add_row({std::string(line.method.title), tool::formatted("%.4f", score.precision()),
                     tool::formatted("%.4f", score.precision(true)),
                     tool::formatted("%.4f", score.precision_of_corners()),
                     tool::formatted("%.4f", score.precision_of_corners(true)),
                     tool::formatted("%.4f", score.recall_of_supported()),
                     tool::formatted("%.4f", score.recall_of_visible()),
                     tool::formatted("%.2f", kMm * quantile(errors_m, 0.5)),
                     tool::formatted("%.2f", kMm * quantile(errors_m, 0.95)),
                     tool::formatted("%.3f", false_count / scans)});
    }
    out += corners.conditions + '\n' + table.text(true) + '\n';
  }
  out +=
      "  precision: share of the detections within 60 mm of a corner with both walls visible;\n"
      "    terminals with one visible wall are not counted, under 'strict' they are false\n"
      "  of corners: precision of the detections of kind corner, without terminals\n"
      "  recall 5: detected share of the corners with 5 returns or more on both walls\n"
      "  recall 1: detected share of the corners with a return on both walls\n"
      "  median, 95 %: distance of the true detections from their corners\n"
      "  false: detections per scan that are no corner or repeat one\n";
  return out;
}

}  // namespace cornerd::bench
