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

/// Settings, their map, and what localizes in it.
struct Loaded {
  settings::Config config;
  std::shared_ptr<const core::WallMap> map;
  std::unique_ptr<core::Pipeline> pipeline;
};

/// Reads settings and map again in a thread of its own: a large building's catalogue takes its
/// time, and nobody waits for it.
class Reloader {
 public:
  /// Throws where the settings or the map are wrong.
  using Load = std::function<Loaded()>;

  struct Outcome {
    Loaded loaded;
    std::string error;  ///< one line; empty: all is well
  };

  /// Throws std::system_error.
  explicit Reloader(Load load);

  /// Begins to load. Asked for while it loads, it loads once more when that is done.
  void start();

  /// Readable when there is an outcome.
  int event_fd() const { return done_.get(); }
  /// Of the load that has ended.
  Outcome take();

 private:
  void run();

  Load load_;
  FileDescriptor done_;
  bool is_loading_ = false;
  bool reload_pending_ = false;
  Outcome outcome_;  ///< the thread's, until done_ says otherwise
  std::jthread thread_;
};

}  // namespace cornerd::daemon
