// SPDX-License-Identifier: MIT
#include "bench/instruction_counter.hpp"

#include <fcntl.h>
#include <linux/perf_event.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <string_view>

namespace cornerd::bench {

InstructionCounter::InstructionCounter() {
  perf_event_attr attributes{};
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.size = sizeof attributes;
  attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  constexpr int kThisThread = 0;
  constexpr int kAnyCpu = -1;
  constexpr int kNoGroup = -1;
  descriptor_ = static_cast<int>(syscall(SYS_perf_event_open, &attributes, kThisThread, kAnyCpu,
                                         kNoGroup, PERF_FLAG_FD_CLOEXEC));
}

InstructionCounter::~InstructionCounter() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<std::uint64_t> InstructionCounter::read() const {
  std::uint64_t value = 0;
  if (descriptor_ < 0 || ::read(descriptor_, &value, sizeof value) != sizeof value) {
    return std::nullopt;
  }
  return value;
}

namespace {

/// Standard error of a program; nullopt where it cannot be run or fails.
std::optional<std::string> standard_error_of(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const bool started =
      posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);

  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = read(ends[0], buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  if (!started || waitpid(child, &status, 0) != child) return std::nullopt;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return text;
}

}  // namespace

std::optional<std::uint64_t> parse_callgrind_report(const std::string& report) {
  constexpr std::string_view kLabel = "Collected : ";
  const std::size_t label = report.find(kLabel);
  if (label == std::string::npos) return std::nullopt;
  std::uint64_t count = 0;
  const char* const begin = report.data() + label + kLabel.size();
  const auto result = std::from_chars(begin, report.data() + report.size(), count);
  if (result.ec != std::errc()) return std::nullopt;
  return count;
}

std::optional<std::uint64_t> count_by_callgrind(const std::vector<std::string>& words) {
  // Under valgrind /proc/self/exe is valgrind, so the path is read here.
  std::array<char, 4096> self{};
  const ssize_t length = readlink("/proc/self/exe", self.data(), self.size());
  if (length <= 0 || static_cast<std::size_t>(length) == self.size()) return std::nullopt;
  std::vector<std::string> command = {"valgrind", "--tool=callgrind",
                                      "--callgrind-out-file=/dev/null",
                                      std::string(self.data(), static_cast<std::size_t>(length))};
  command.insert(command.end(), words.begin(), words.end());
  const std::optional<std::string> report = standard_error_of(command);
  return report ? parse_callgrind_report(*report) : std::nullopt;
}

}  // namespace cornerd::bench
