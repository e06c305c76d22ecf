// SPDX-License-Identifier: MIT
#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "bench/paper_experiment.hpp"
#include "bench/program/report.hpp"
#include "bench/statistics.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

namespace {

using PoseResults = std::vector<const PoseResult*>;

constexpr double kBenchMm = 1e3;
constexpr std::size_t kReference = 1;  // index of ABD+IEPF in the paper's methods

/// The paper's column of a method; nullopt if the paper has none.
std::optional<std::size_t> paper_index(const NamedMethod& method) {
  const auto methods = paper_methods();
  for (std::size_t i = 0; i < methods.size() && i < kPaperMethodCount; ++i) {
    if (methods[i].name == method.name) return i;
  }
  return std::nullopt;
}

PoseResults all_poses(const PaperResult& result) {
  PoseResults poses;
  for (const PoseResult& pose : result.poses) poses.push_back(&pose);
  return poses;
}

PoseResults poses_at(const BenchReport& report, const PaperResult& result, std::size_t location) {
  PoseResults poses;
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    if (report.scans.poses[i].location == location) poses.push_back(&result.poses[i]);
  }
  return poses;
}

MeanAndDeviation time_of(const PoseResults& poses) {
  std::vector<double> times_us;
  for (const PoseResult* pose : poses) times_us.push_back(pose->time_us);
  return mean_and_deviation(times_us);
}

struct TrueAndFalse {
  std::size_t true_corners = 0;
  std::size_t false_corners = 0;
  std::size_t poses_with_false = 0;
};
TrueAndFalse count_corners(const PoseResults& poses) {
  TrueAndFalse counts;
  for (const PoseResult* pose : poses) {
    counts.true_corners += pose->true_corners;
    counts.false_corners += pose->false_corners;
    counts.poses_with_false += pose->false_corners > 0 ? 1 : 0;
  }
  return counts;
}

TrueAndFalse paper_corners(std::size_t index) {
  TrueAndFalse counts;
  for (const PaperLocation& location : kPaperLocations) {
    counts.true_corners += location.cells[index].true_corners;
    counts.false_corners += location.cells[index].false_corners;
  }
  return counts;
}

/// A table whose columns are the methods, three side by side.
class MethodTable {
 public:
  using Cell = std::function<std::string(const PaperResult& result)>;
  MethodTable(const BenchReport& report, const std::string& label) : report_(report) {
    add_row(label, "poses",
            [](const PaperResult& result) { return std::string(result.method.title); });
  }
  void add_row(const std::string& label, const std::string& poses, const Cell& cell) {
    std::vector<std::string> row = {label, poses};
    for (const PaperResult& result : report_.paper) row.push_back(cell(result));
    rows_.push_back(std::move(row));
  }

  std::string text() const {
    constexpr std::size_t kLabels = 2;
    constexpr std::size_t kSideBySide = 3;
    std::string out;
    for (std::size_t first = 0; first < report_.paper.size(); first += kSideBySide) {
      const std::size_t count = std::min(kSideBySide, report_.paper.size() - first);
      tool::TextTable table;
      for (const std::vector<std::string>& row : rows_) {
        std::vector<std::string> part(row.begin(), row.begin() + kLabels);
        const auto begin = row.begin() + static_cast<std::ptrdiff_t>(kLabels + first);
        part.insert(part.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
        table.add_row(std::move(part));
      }
      out += (first > 0 ? "\n" : "") + table.text();
    }
    return out;
  }

 private:
  const BenchReport& report_;
  std::vector<std::vector<std::string>> rows_;
};

std::string time_text(const MeanAndDeviation& time, const PaperMean* paper) {
  std::string text = tool::formatted("%.1f +- %.1f", time.mean, time.deviation);
  if (paper != nullptr)
    text += tool::formatted(" (%.1f +- %.1f ms)", paper->mean, paper->deviation);
  return text;
}

std::string error_text(const std::vector<double>& errors_m) {
  const MeanAndDeviation error = mean_and_deviation(errors_m);
  return tool::formatted("%.2f +- %.2f (%zu)", kBenchMm * error.mean, kBenchMm * error.deviation,
                         errors_m.size());
}

std::string instruction_text(const std::optional<double>& count) {
  return count ? tool::formatted("%.0f", *count) : "-";
}

}  // namespace

std::string time_table(const BenchReport& report) {
  MethodTable table(report, "location");
  for (std::size_t location = 0; location < kPaperLocations.size(); ++location) {
    const PaperLocation& paper = kPaperLocations[location];
    table.add_row(std::string(paper.title), std::to_string(paper.poses),
                  [&](const PaperResult& result) {
                    const MeanAndDeviation time = time_of(poses_at(report, result, location));
                    const auto index = paper_index(result.method);
                    if (!index) return time_text(time, nullptr);
                    const PaperMean printed{paper.cells[*index].time_ms,
                                            paper.cells[*index].time_deviation_ms};
                    return time_text(time, &printed);
                  });
  }
  double reference_us = 0;
  table.add_row("all", std::to_string(report.scans.poses.size()), [&](const PaperResult& result) {
    const MeanAndDeviation time = time_of(all_poses(result));
    const auto index = paper_index(result.method);
    if (index == kReference) reference_us = time.mean;
    return time_text(time, index ? &kPaperTimes_ms[*index] : nullptr);
  });
  if (reference_us > 0) {
    table.add_row("of ABD+IEPF", "", [&](const PaperResult& result) {
      const double share = time_of(all_poses(result)).mean / reference_us;
      const auto index = paper_index(result.method);
      if (!index) return tool::formatted("%.2f", share);
      return tool::formatted("%.2f (%.2f)", share,
                             kPaperTimes_ms[*index].mean / kPaperTimes_ms[kReference].mean);
    });
  }
  if (!report.instructions.empty()) {
    table.add_row("instructions", "", [&](const PaperResult& result) {
      return instruction_text(report.instructions_of(result.method.title, report.samples));
    });
  }
  return "Table I: time a scan, microseconds (the paper's)\n" + table.text() +
         tool::formatted(
             "  Sorting a scan and converting it to Cartesian coordinates takes %.1f us more.\n",
             report.preparation_us);
}

std::string true_false_table(const BenchReport& report) {
  MethodTable table(report, "location");
  for (std::size_t location = 0; location < kPaperLocations.size(); ++location) {
    const PaperLocation& paper = kPaperLocations[location];
    table.add_row(std::string(paper.title), std::to_string(paper.poses),
                  [&](const PaperResult& result) {
                    const TrueAndFalse counts = count_corners(poses_at(report, result, location));
                    std::string text =
                        tool::formatted("%zu / %zu", counts.true_corners, counts.false_corners);
                    if (const auto index = paper_index(result.method)) {
                      text += tool::formatted(" (%zu / %zu)", paper.cells[*index].true_corners,
                                              paper.cells[*index].false_corners);
                    }
                    return text;
                  });
  }
  table.add_row("all", std::to_string(report.scans.poses.size()), [&](const PaperResult& result) {
    const TrueAndFalse counts = count_corners(all_poses(result));
    std::string text = tool::formatted("%zu / %zu", counts.true_corners, counts.false_corners);
    if (const auto index = paper_index(result.method)) {
      const TrueAndFalse paper = paper_corners(*index);
      text += tool::formatted(" (%zu / %zu)", paper.true_corners, paper.false_corners);
    }
    return text;
  });
  table.add_row("poses with a false one", "", [&](const PaperResult& result) {
    return std::to_string(count_corners(all_poses(result)).poses_with_false);
  });
  table.add_row("missed, with 5 returns", "", [&](const PaperResult& result) {
    std::size_t missed = 0;
    for (const PoseResult& pose : result.poses) missed += pose.missed_corners;
    return std::to_string(missed);
  });
  std::size_t supported = 0;
  for (const std::size_t count : report.supported_corners) supported += count;
  return "Table II: true / false corners (the paper's)\n" + table.text() +
         tool::formatted("  The scans show %zu corners whose walls both give 5 returns or more.\n",
                         supported);
}

std::string position_table(const BenchReport& report) {
  tool::TextTable table;
  table.add_row({"method", "two nearest corners", "the paper's", "cornerd"});
  for (const PaperResult& result : report.paper) {
    std::vector<double> nearest_m;
    std::vector<double> localizer_m;
    for (const PoseResult& pose : result.poses) {
      if (pose.nearest_corners_error_m) nearest_m.push_back(*pose.nearest_corners_error_m);
      if (pose.localizer_error_m) localizer_m.push_back(*pose.localizer_error_m);
    }
    std::string paper = "-";
    const auto index = paper_index(result.method);
    if (index && *index < kPaperPositionErrors_mm.size()) {
      const PaperMean& printed = kPaperPositionErrors_mm[*index];
      paper = tool::formatted("%.2f +- %.2f", printed.mean, printed.deviation);
    }
    table.add_row(
        {std::string(result.method.title), error_text(nearest_m), paper, error_text(localizer_m)});
  }
  return "Position error, mm: mean +- standard deviation (poses with a position)\n" + table.text();
}

std::string scaling_table(const BenchReport& report) {
  std::vector<std::size_t> sizes;
  for (const InstructionFigure& figure : report.instructions) sizes.push_back(figure.samples);
  std::sort(sizes.begin(), sizes.end());
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  tool::TextTable table;
  std::vector<std::string> header = {"samples"};
  for (const PaperResult& result : report.paper) header.emplace_back(result.method.title);
  table.add_row(header);
  for (const std::size_t samples : sizes) {
    std::vector<std::string> row = {std::to_string(samples)};
    for (const PaperResult& result : report.paper) {
      const auto count = report.instructions_of(result.method.title, samples);
      row.push_back(instruction_text(count));
      if (count) row.back() += tool::formatted(" (%.0f)", *count / static_cast<double>(samples));
    }
    table.add_row(row);
  }
  return "Instructions a scan (a sample), counted by " + report.counter + "\n" + table.text(true);
}

std::string bench_text(const BenchReport& report) {
  std::string out = tool::formatted("%zu samples a scan, seed %llu\n\n", report.samples,
                                    static_cast<unsigned long long>(report.seed));
  out += time_table(report) + '\n' + true_false_table(report) + '\n' + position_table(report);
  if (!report.instructions.empty()) out += '\n' + scaling_table(report);
  if (!report.corners.empty()) out += '\n' + corner_tables(report);
  return out;
}

}  // namespace cornerd::bench
