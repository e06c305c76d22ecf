// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/scan.hpp"
#include "replay/recording.hpp"
#include "replay/simulator/scene.hpp"

namespace cornerd::replay {

/// The scans of a recording, repeated endlessly. A ray has the range of the nearest recorded
/// sample, so the scene can be scanned in any mode.
class RecordedScene : public Scene {
 public:
  /// Throws RecordingError if the file cannot be read or has no complete scan.
  RecordedScene(std::filesystem::path file, const RecordingOptions& options);
  ~RecordedScene() override;

  double range_along(core::TimeNs t_ns, std::int64_t scan, const core::Vec2& origin,
                     double bearing_rad) override;

 private:
  class ScanCollector;
  struct Return {
    double bearing_rad = 0;
    double range_m = 0;
  };

  void open();
  void load_next_scan();
  double nearest_range(double bearing_rad) const;

  std::filesystem::path file_;
  RecordingOptions options_;
  std::unique_ptr<RecordingPlayer> player_;
  std::unique_ptr<ScanCollector> scans_;
  std::int64_t scan_ = 0;
  std::vector<Return> returns_;  ///< of the current scan, by bearing, empty ones included
};

}  // namespace cornerd::replay
