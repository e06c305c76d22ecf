// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
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

/// The built cornerd, running. Killed at the end where it still does.
class DaemonProcess {
 public:
  /// `errors`: where standard error and standard output go; empty: with all three streams closed.
  /// `sockets`: that listen, passed on as a service manager does.
  DaemonProcess(const std::vector<std::string>& arguments, const std::filesystem::path& errors,
                const std::map<std::string, std::string>& environment = {},
                const std::vector<int>& sockets = {});
  ~DaemonProcess();
  DaemonProcess(const DaemonProcess&) = delete;
  DaemonProcess& operator=(const DaemonProcess&) = delete;

  void send_signal(int signal) const;
  bool is_running() const;
  pid_t pid() const { return pid_; }
  /// The exit code; nullopt where it does not end in time, or by a signal.
  std::optional<int> wait_for_exit();
  /// What it wrote to standard error and standard output.
  std::string output() const;

 private:
  pid_t pid_ = -1;
  std::filesystem::path errors_;
};

/// A folder with a map, a recording, and settings that play it.
class DaemonTest : public ::testing::Test {
 protected:
  DaemonTest();

  /// cornerd with the settings of the folder, and some of them in place of the file's.
  DaemonProcess start(const std::vector<std::string>& overrides = {},
                      const std::map<std::string, std::string>& environment = {});
  /// Runs cornerd to its end.
  struct Result {
    std::optional<int> exit_code;
    std::string output;
  };
  Result run(const std::vector<std::string>& arguments);

  /// A client of the socket, once that is there.
  TestClient connect(const char* socket = "pose.sock");
  /// The next message of that class.
  static json next_of(TestClient& client, const std::string& message_class);
  static json next(TestClient& client);

  std::vector<std::string> with_config() const { return {"--config", config()}; }
  std::string config() const { return (folder_ / "cornerd.json").string(); }

  test::TemporaryFolder folder_;
};

}  // namespace cornerd::system_test
