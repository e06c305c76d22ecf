// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "command_run.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::tool {

/// Records a drive with wheels and a gyro through the flat.
class OdometryCommandTest : public ::testing::Test {
 protected:
  CommandRun simulate(std::vector<std::string> more, const std::string& scans = "150") {
    std::vector<std::string> words = {
        "simulate", "--map",    map_,      "--scenario", "circuit-1",  "--scans",       scans,
        "-o",       recording_, "--truth", truth_,       "--odometry", "--drive-speed", "0.4"};
    words.insert(words.end(), more.begin(), more.end());
    return CommandRun(words);
  }
  CommandRun replay(std::vector<std::string> more) {
    std::vector<std::string> words = {"replay", recording_, "--map", map_, "--truth", truth_};
    words.insert(words.end(), more.begin(), more.end());
    return CommandRun(words);
  }
  /// The recording with each ODOMETRY line changed.
  void rewrite(const std::string& file,
               const std::function<void(nlohmann::json& line)>& change) const {
    std::ifstream from(recording_);
    std::ofstream to(file);
    for (std::string text; std::getline(from, text);) {
      auto line = nlohmann::json::parse(text);
      if (line["class"] == "ODOMETRY") change(line);
      to << line.dump() << '\n';
    }
  }

  test::TemporaryFolder folder_;
  const std::string map_ = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
  const std::string recording_ = (folder_.path() / "drive.ndjson").string();
  const std::string truth_ = (folder_.path() / "truth.ndjson").string();
};

}  // namespace cornerd::tool
