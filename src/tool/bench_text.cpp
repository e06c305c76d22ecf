// SPDX-License-Identifier: MIT
#include "tool/bench_text.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <vector>

#include "bench/statistics.hpp"

namespace cornerd::tool {

namespace {

constexpr double kBenchMm = 1e3;

__attribute__((format(printf, 2, 3))) void add_line(std::string& out, const char* format, ...) {
  char line[200];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out += line;
  out += '\n';
}

}  // namespace

std::string corner_table(const std::string& title, std::span<const bench::MethodScore> scores) {
  std::string out = title + '\n';
  add_line(out, "  %-22s %9s %7s %9s %9s %8s %8s %10s %10s %8s", "method", "precision", "strict",
           "corners", "strict", "recall 5", "recall 1", "median mm", "95 % mm", "false");
  for (const bench::MethodScore& line : scores) {
    const bench::CornerScore& score = line.score;
    std::vector<double> errors_m = score.errors_m();
    std::sort(errors_m.begin(), errors_m.end());
    const double false_a_turn =
        score.turns() == 0 ? 0
                           : static_cast<double>(score.detections(bench::Verdict::kFalse)) /
                                 static_cast<double>(score.turns());
    add_line(out, "  %-22.*s %9.4f %7.4f %9.4f %9.4f %8.4f %8.4f %10.2f %10.2f %8.3f",
             static_cast<int>(line.method.title.size()), line.method.title.data(),
             score.precision(), score.precision(true), score.precision_of_corners(),
             score.precision_of_corners(true), score.recall_of_supported(),
             score.recall_of_visible(), kBenchMm * bench::quantile(errors_m, 0.5),
             kBenchMm * bench::quantile(errors_m, 0.95), false_a_turn);
  }
  return out;
}

std::string corner_table_legend() {
  return "precision: share of the detections within 60 mm of a corner that shows both its walls;\n"
         "  wall ends that show one wall are left out, under 'strict' they are false\n"
         "corners: the same of the detections that claim to be corners, not wall ends\n"
         "recall 5: share found of the corners whose walls both give 5 returns or more\n"
         "recall 1: share found of all corners whose walls both give a return\n"
         "false: detections a turn that are no corner, or one that was found already\n";
}

}  // namespace cornerd::tool
