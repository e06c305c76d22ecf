// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/temporary_folder.hpp"
#include "tests/unit/daemon/test_client.hpp"

namespace cornerd::system_test {

using daemon::TestClient;
using nlohmann::json;

/// The built cornerd as a process; the destructor kills it.
class DaemonProcess {
 public:
  /// `errors`: target of standard error and standard output; if empty, all three streams are
  /// closed. `sockets`: listening sockets, passed as a service manager does. `program`: another
  /// one.
  DaemonProcess(const std::vector<std::string>& arguments, const std::filesystem::path& errors,
                const std::map<std::string, std::string>& environment = {},
                const std::vector<int>& sockets = {}, std::string program = CORNERD_BINARY);
  ~DaemonProcess();
  DaemonProcess(const DaemonProcess&) = delete;
  DaemonProcess& operator=(const DaemonProcess&) = delete;

  void send_signal(int signal) const;
  bool is_running() const;
  pid_t pid() const { return pid_; }
  /// The exit code; nullopt after a timeout or a signal.
  std::optional<int> wait_for_exit();
  /// Its standard error and standard output.
  std::string output() const;

 private:
  pid_t pid_ = -1;
  std::filesystem::path errors_;
};

/// A folder with a map, a recording, and a config that replays it.
class DaemonTest : public ::testing::Test {
 protected:
  DaemonTest();

  /// Starts cornerd with the folder's config and overrides.
  DaemonProcess start(const std::vector<std::string>& overrides = {},
                      const std::map<std::string, std::string>& environment = {});
  /// Runs cornerd until it ends.
  struct Result {
    std::optional<int> exit_code;
    std::string output;
  };
  Result run(const std::vector<std::string>& arguments);

  /// A client of the socket; waits for the socket.
  TestClient connect(const char* socket = "pose.sock");
  /// The first message that `is_it`; "nothing" if none came in time.
  static json next_where(TestClient& client, const std::function<bool(const json&)>& is_it);
  /// The next message of this class, or the first of them that `is_it`.
  static json next_of(TestClient& client, const std::string& message_class,
                      const std::function<bool(const json&)>& is_it = {});
  static json next(TestClient& client);
  static json next_event(TestClient& client, const std::string& what);
  static json wait_for_fix(TestClient& client);

  std::vector<std::string> with_config() const { return {"--config", config()}; }
  std::string config() const { return (folder_ / "cornerd.json").string(); }

  test::TemporaryFolder folder_;
};

}  // namespace cornerd::system_test
