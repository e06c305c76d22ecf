// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/odometry_experiment.hpp"
#include "bench/program/benches.hpp"
#include "bench/program/contest_maps.hpp"
#include "bench/program/odometry_text.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/progress_bar.hpp"
#include "tool/drawing/factors_text.hpp"
#include "tool/drawing/map_drawing.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::bench {

namespace {

using calibration::HeadingSource;

/// Of the table by rate, for each of --positions drives.
constexpr std::size_t kScansPerDrive = 650;

struct RobotResults {
  OdometryRobot robot;
  std::vector<OdometryResult> drives;
};

std::string_view name_of(HeadingSource source) {
  switch (source) {
    case HeadingSource::kEncoder:
      return "encoder";
    case HeadingSource::kGyro:
      return "gyro";
    case HeadingSource::kMean:
      return "mean";
    case HeadingSource::kWeighted:
      return "weighted";
    case HeadingSource::kFilter:
      break;
  }
  return "least squares";
}

std::string title_of(const ReckonedTrack& track) {
  const std::string name(name_of(track.source));
  if (track.source == HeadingSource::kMean) return name + " (eq. 4)";
  if (track.source == HeadingSource::kWeighted) return name + " (eq. 5)";
  if (track.source == HeadingSource::kFilter) return name + ", ours";
  return track.factors ? name + ", factor" : name;
}

std::string factors_text(const ReckonedTrack& track) {
  return track.factors ? tool::describe_factors(track.source, *track.factors) : "-";
}

/// The same mode without the dead band; `track` if there is none.
const ReckonedTrack& without_dead_band(const OdometryResult& drive, const ReckonedTrack& track) {
  const auto other = std::find_if(drive.tracks.begin(), drive.tracks.end(), [&](const auto& one) {
    return one.source == track.source && !one.as_printed &&
           one.factors.has_value() == track.factors.has_value();
  });
  return other == drive.tracks.end() ? track : *other;
}

std::string table_of(const OdometryResult& drive) {
  tool::TextTable table;
  table.add_row(
      {"heading from", "factors", "mean [m]", "end [m]", "factors", "mean [m]", "end [m]"});
  for (const ReckonedTrack& track : drive.tracks) {
    if (!track.as_printed && track.source != HeadingSource::kFilter) continue;
    std::vector<std::string> row = {title_of(track)};
    const auto add = [&row](const ReckonedTrack& one) {
      row.push_back(factors_text(one));
      row.push_back(tool::formatted("%.3f", one.error.mean_m));
      row.push_back(tool::formatted("%.3f", one.error.end_m));
    };
    if (track.as_printed) {
      add(track);
    } else {
      row.insert(row.end(), 3, "-");
    }
    add(without_dead_band(drive, track));
    table.add_row(row);
  }
  return tool::formatted("%.*s, %.1f m\n", static_cast<int>(drive.scenario.size()),
                         drive.scenario.data(), drive.length_m) +
         table.text() + '\n';
}

bool has_factors_at_edge(const RobotResults& results) {
  for (const OdometryResult& drive : results.drives) {
    for (const ReckonedTrack& track : drive.tracks) {
      if (track.factors && track.factors->at_edge()) return true;
    }
  }
  return false;
}

std::string odometry_text(const std::vector<RobotResults>& robots) {
  std::string text =
      "Dead reckoning by odometry: mean error and error at the end of one circuit. Factors are\n"
      "fitted to the same drive. Left: as printed, with a step every 0.1 s and a dead band of\n"
      "0.01 rad. Right: with a step for each reading, without a dead band.\n\n";
  bool at_edge = false;
  for (const RobotResults& results : robots) {
    text.append(results.robot.title).append("\n\n");
    for (const OdometryResult& drive : results.drives) text.append(table_of(drive));
    at_edge = at_edge || has_factors_at_edge(results);
  }
  if (at_edge) return text.append(tool::kEdgeText);
  text.pop_back();
  return text;
}

std::string odometry_json(const std::vector<RobotResults>& robots,
                          const std::vector<DeadReckoningRow>& predictions,
                          const std::vector<RateRow>& rates, std::uint64_t seed) {
  nlohmann::ordered_json drives = nlohmann::ordered_json::array();
  for (const RobotResults& results : robots) {
    for (const OdometryResult& drive : results.drives) {
      nlohmann::ordered_json tracks = nlohmann::ordered_json::array();
      for (const ReckonedTrack& track : drive.tracks) {
        nlohmann::ordered_json figures = {{"heading", name_of(track.source)}};
        if (track.source != HeadingSource::kFilter) figures["as_printed"] = track.as_printed;
        if (track.factors) {
          figures["encoder_factor"] = track.factors->factors.encoder_factor;
          figures["gyro_factor"] = track.factors->factors.gyro_factor;
          figures["at_edge"] = track.factors->at_edge();
        }
        figures["mean_error"] = track.error.mean_m;
        figures["end_error"] = track.error.end_m;
        tracks.push_back(std::move(figures));
      }
      drives.push_back({{"robot", results.robot.name},
                        {"drive", drive.scenario},
                        {"length", drive.length_m},
                        {"tracks", std::move(tracks)}});
    }
  }
  return nlohmann::ordered_json({{"seed", seed},
                                 {"odometry", std::move(drives)},
                                 {"dead_reckoned", dead_reckoning_json(predictions)},
                                 {"rates", rate_json(rates)}})
             .dump(2) +
         '\n';
}

/// The modes without factors, or with factors and least squares.
std::string draw_tracks(const core::WallMap& map, const OdometryRobot& robot,
                        const OdometryResult& drive, bool with_factors, bool as_printed) {
  tool::MapDrawing drawing(map);
  drawing.add_path(drive.truth, /*truth=*/true);
  drawing.add_legend("truth", "#2f3640");
  for (const ReckonedTrack& track : drive.tracks) {
    const bool is_least_squares = track.source == HeadingSource::kFilter;
    if ((track.factors || is_least_squares) != with_factors) continue;
    if (track.as_printed != as_printed && !is_least_squares) continue;
    constexpr std::string_view kInks[] = {"#c2255c", "#2f6f9f", "#d9822b", "#d9822b", "#1b9e77"};
    const std::string_view ink = kInks[static_cast<std::size_t>(track.source)];
    drawing.add_track(track.points, ink);
    drawing.add_legend(title_of(track), ink);
  }
  return drawing.document(
      std::string(robot.title) + ", " + std::string(drive.scenario) +
      (with_factors ? ": odometry with factors" : ": odometry without factors") +
      (as_printed ? "" : ", no dead band"));
}

}  // namespace

void run_odometry_bench(const OdometryBenchOptions& options) {
  // Fails before the work if the file cannot be written.
  std::unique_ptr<tool::Output> json;
  if (options.json == "-") json = std::make_unique<tool::Output>();
  if (!options.json.empty() && !json) {
    json = std::make_unique<tool::Output>(std::filesystem::path(options.json));
  }
  const std::shared_ptr<const core::WallMap> map =
      settings::load_map(contest_maps_folder(options.maps) / "flat-7.json");
  if (!options.plots.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.plots, error);
    if (error) throw tool::Failure(options.plots.string() + ": " + error.message());
  }

  std::vector<RobotResults> robots;
  std::vector<DeadReckoningRow> predictions;
  std::vector<RateRow> rates;
  {
    const auto all = odometry_robots();
    const auto cases = covered_lidar_cases();
    tool::ProgressBar bar("odometry", all.size() * replay::scenarios().size() + cases.size() +
                                          2 * std::size(kReadingRates_hz));
    std::size_t done = 0;
    for (const OdometryRobot& robot : all) {
      robots.push_back({robot, {}});
      for (const replay::Scenario& scenario : replay::scenarios()) {
        robots.back().drives.push_back(run_odometry_case(robot, scenario, options.seed));
        bar.show(++done);
      }
    }
    for (const CoveredLidarCase& one : cases) {
      if (options.drives == 0) break;
      predictions.push_back(
          {one.title, run_covered_lidar_case(map, one, options.seed, options.drives)});
      bar.show(++done);
    }
    for (const bool gently : {false, true}) {
      for (const double rate_hz : kReadingRates_hz) {
        if (options.drives == 0) break;
        const std::size_t scans = kScansPerDrive * options.drives;
        rates.push_back(
            {rate_hz, gently, run_rate_case(map, rate_hz, gently, scans, options.seed)});
        bar.show(++done);
      }
    }
  }
  for (const RobotResults& results : robots) {
    for (const OdometryResult& drive : results.drives) {
      if (options.plots.empty()) break;
      const std::string name = std::string(results.robot.name) + '-' + std::string(drive.scenario);
      for (const bool with_factors : {false, true}) {
        for (const bool as_printed : {true, false}) {
          const std::string variant = std::string(with_factors ? "-factors" : "") +
                                      (as_printed ? "" : "-no-dead-band") + ".svg";
          tool::write_file(options.plots / (name + variant),
                           draw_tracks(*map, results.robot, drive, with_factors, as_printed));
        }
      }
    }
  }
  if (json) {
    json->write(odometry_json(robots, predictions, rates, options.seed));
    json->flush();
  }
  if (options.json == "-") return;
  tool::Output output;
  output.write(odometry_text(robots));
  if (options.drives > 0)
    output.write('\n' + dead_reckoning_text(predictions) + '\n' + rate_text(rates));
  output.flush();
}

}  // namespace cornerd::bench
