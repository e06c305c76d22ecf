// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "core/map/wall_map.hpp"
#include "core/pipeline.hpp"
#include "daemon/require_fd.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// The config, its map, and a pipeline for them.
struct Loaded {
  settings::Config config;
  std::shared_ptr<const core::WallMap> map;
  std::unique_ptr<core::Pipeline> pipeline;
};

/// Loads config and map in a thread of its own, because the catalogue of a large map takes seconds.
class Reloader {
 public:
  /// Throws if the config or the map is invalid.
  using Load = std::function<Loaded()>;

  struct Outcome {
    Loaded loaded;
    std::string error;  ///< one line; empty on success
  };

  /// Throws std::system_error.
  explicit Reloader(Load load);

  /// Starts loading. A call during loading makes it load once more afterwards.
  void start();

  /// Readable when there is an outcome.
  int event_fd() const { return done_.get(); }
  /// The outcome of the finished load.
  Outcome take();

 private:
  void run();

  Load load_;
  FileDescriptor done_;
  bool is_loading_ = false;
  bool reload_pending_ = false;
  Outcome outcome_;  ///< owned by the thread until done_ is readable
  std::jthread thread_;
};

}  // namespace cornerd::daemon
