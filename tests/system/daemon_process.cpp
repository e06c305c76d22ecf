// SPDX-License-Identifier: MIT
#include "daemon_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "room_recording.hpp"
#include "tests/wait_until.hpp"

namespace cornerd::system_test {
namespace {

using test::wait_until;

/// Consecutive descriptors from 3 on, see sd_listen_fds(3).
void pass_on(const std::vector<int>& sockets) {
  constexpr int kFirst = 3;
  constexpr int kOutOfTheWay = 100;
  std::vector<int> copies;
  for (const int fd : sockets) copies.push_back(::fcntl(fd, F_DUPFD, kOutOfTheWay));
  for (std::size_t i = 0; i < copies.size(); ++i) ::dup2(copies[i], kFirst + static_cast<int>(i));
  ::setenv("LISTEN_FDS", std::to_string(sockets.size()).c_str(), 1);
  ::setenv("LISTEN_PID", std::to_string(::getpid()).c_str(), 1);
}

}  // namespace

DaemonProcess::DaemonProcess(const std::vector<std::string>& arguments,
                             const std::filesystem::path& errors,
                             const std::map<std::string, std::string>& environment,
                             const std::vector<int>& sockets, std::string program)
    : errors_(errors) {
  std::vector<char*> argv;
  argv.push_back(program.data());
  std::vector<std::string> copies = arguments;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ != 0) return;
  if (errors_.empty()) {
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(fd);
  } else {
    const int fd = ::open(errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(fd, STDOUT_FILENO);
    ::dup2(fd, STDERR_FILENO);
  }
  ::signal(SIGPIPE, SIG_DFL);  // the test runner may have ignored it
  for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
  if (!sockets.empty()) pass_on(sockets);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

DaemonProcess::~DaemonProcess() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void DaemonProcess::send_signal(int signal) const { ::kill(pid_, signal); }

bool DaemonProcess::is_running() const {
  siginfo_t ended{};
  const int result = ::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT);
  return result == 0 && ended.si_pid == 0;
}

std::optional<int> DaemonProcess::wait_for_exit() {
  int status = 0;
  pid_t ended = 0;
  if (!wait_until([&] { return (ended = ::waitpid(pid_, &status, WNOHANG)) != 0; })) return {};
  pid_ = -1;
  return ended > 0 && WIFEXITED(status) ? std::optional(WEXITSTATUS(status)) : std::nullopt;
}

std::string DaemonProcess::output() const {
  std::ostringstream text;
  text << std::ifstream(errors_).rdbuf();
  return text.str();
}

DaemonTest::DaemonTest() {
  write_map(folder_ / "map.json");
  write_recording(folder_ / "room.ndjson", 10);
  std::ofstream(folder_ / "cornerd.json") << R"({
    "lidar": { "driver": "replay", "file": "room.ndjson", "speed": 5, "loop": true },
    "map": "map.json",
    "socket": { "pose": "pose.sock", "control": "control.sock" },
    "advanced": { "realtime": { "priority": 0, "lock_memory": false } } })";
}

DaemonProcess DaemonTest::start(const std::vector<std::string>& overrides,
                                const std::map<std::string, std::string>& environment) {
  std::vector<std::string> arguments = {"--config", config()};
  for (const std::string& text : overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(text);
  }
  return {arguments, folder_ / "log", environment};
}

DaemonTest::Result DaemonTest::run(const std::vector<std::string>& arguments) {
  DaemonProcess process(arguments, folder_ / "output");
  Result result{process.wait_for_exit(), {}};
  result.output = process.output();
  return result;
}

TestClient DaemonTest::connect(const char* socket) {
  std::optional<TestClient> client;
  EXPECT_TRUE(wait_until([&] { return client.emplace(folder_ / socket).is_connected(); }))
      << "no daemon listens on " << socket;
  return std::move(*client);
}

json DaemonTest::next(TestClient& client) {
  const auto line = client.read_line(std::chrono::milliseconds(test::kPatience).count());
  return line ? json::parse(*line) : json("nothing");
}

json DaemonTest::next_where(TestClient& client, const std::function<bool(const json&)>& is_it) {
  const auto deadline = std::chrono::steady_clock::now() + test::kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    json message = next(client);
    if (!message.is_object() || is_it(message)) return message;
  }
  return "nothing";
}

json DaemonTest::next_of(TestClient& client, const std::string& message_class,
                         const std::function<bool(const json&)>& is_it) {
  return next_where(client, [&](const json& message) {
    return message["class"] == message_class && (!is_it || is_it(message));
  });
}

json DaemonTest::next_event(TestClient& client, const std::string& what) {
  return next_of(client, "EVENT", [&](const json& event) { return event["what"] == what; });
}

json DaemonTest::wait_for_fix(TestClient& client) {
  return next_of(client, "POSE", [](const json& pose) { return pose["state"] == "fix"; });
}

}  // namespace cornerd::system_test
