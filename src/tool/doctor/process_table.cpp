// SPDX-License-Identifier: MIT
#include "tool/doctor/process_table.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <sstream>

namespace cornerd::tool {

namespace {

template <typename Integer>
std::optional<Integer> whole_number(std::string_view digits, int base = 10) {
  Integer number{};
  const char* const end = digits.data() + digits.size();
  const auto [last, error] = std::from_chars(digits.data(), end, number, base);
  if (error != std::errc() || last != end) return std::nullopt;
  return number;
}

std::vector<int> process_ids(const Machine& machine) {
  std::vector<int> ids;
  for (const std::string& name : machine.list("/proc")) {
    if (const auto pid = whole_number<int>(name); pid && *pid > 0) ids.push_back(*pid);
  }
  return ids;
}

Process describe_process(const Machine& machine, int pid) {
  return {pid, machine.read_line("/proc/" + std::to_string(pid) + "/comm")};
}

/// A process that has ended, and waits for its parent to ask for its exit code.
bool is_zombie(const Machine& machine, int pid) {
  const std::string stat = machine.read_line("/proc/" + std::to_string(pid) + "/stat");
  // "12 (name) Z 1 ...": the name may have any characters.
  const std::size_t end = stat.rfind(')');
  return end != std::string::npos && stat.size() > end + 2 && stat[end + 2] == 'Z';
}

bool has_open(const Machine& machine, const std::filesystem::path& files,
              const std::string& device) {
  const std::vector<std::string> names = machine.list(files);
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return machine.read_link(files / name) == device;
  });
}

void add_once(std::vector<Process>& processes, Process process) {
  const bool known = std::any_of(processes.begin(), processes.end(),
                                 [&](const Process& one) { return one.pid == process.pid; });
  if (!known) processes.push_back(std::move(process));
}

}  // namespace

std::optional<Process> find_process(const Machine& machine, std::string_view name) {
  for (const int pid : process_ids(machine)) {
    Process process = describe_process(machine, pid);
    if (process.name == name && !is_zombie(machine, pid)) return process;
  }
  return std::nullopt;
}

std::optional<int> lock_owner(std::string_view line, const FileFacts& file) {
  // 1: FLOCK  ADVISORY  WRITE 1234 00:05:345 0 EOF; one that waits for it has "->" after its
  // number.
  const auto words = split_words(line, " \t");
  if (words.size() < 6 || words[1] == "->") return std::nullopt;
  const auto place = split_words(words[5], ":");
  if (place.size() != 3 || whole_number<unsigned>(place[0], 16) != file.device_major ||
      whole_number<unsigned>(place[1], 16) != file.device_minor ||
      whole_number<std::uint64_t>(place[2]) != file.inode) {
    return std::nullopt;
  }
  const auto pid = whole_number<int>(words[4]);
  return pid && *pid > 0 ? pid : std::nullopt;
}

PortHolders holders_of(const Machine& machine, const std::filesystem::path& device) {
  PortHolders holders;
  const std::string self = machine.read_link("/proc/self");
  for (const int pid : process_ids(machine)) {
    if (std::to_string(pid) == self) continue;
    const std::filesystem::path files = "/proc/" + std::to_string(pid) + "/fd";
    if (!machine.may_list(files)) {
      holders.complete = false;
    } else if (has_open(machine, files, device.string())) {
      holders.processes.push_back(describe_process(machine, pid));
    }
  }
  // /proc/locks is readable by everybody, unlike other users' /proc/PID/fd.
  const std::optional<FileFacts> file = machine.facts(device);
  std::istringstream locks(machine.read("/proc/locks").value_or(""));
  for (std::string line; file && std::getline(locks, line);) {
    if (const auto pid = lock_owner(line, *file)) {
      add_once(holders.processes, describe_process(machine, *pid));
    }
  }
  return holders;
}

}  // namespace cornerd::tool
