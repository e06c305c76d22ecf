// SPDX-License-Identifier: MIT
#include "tool/doctor/accounts.hpp"

#include <sys/stat.h>

#include <charconv>
#include <functional>
#include <sstream>
#include <vector>

namespace cornerd::tool {

namespace {

/// Keeps empty fields: "video:*:44:" has four.
std::vector<std::string> split_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ':') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::optional<unsigned> account_number(const std::string& digits) {
  unsigned number = 0;
  const char* const end = digits.data() + digits.size();
  const auto [last, error] = std::from_chars(digits.data(), end, number);
  if (error != std::errc() || last != end) return std::nullopt;
  return number;
}

/// The first line with at least `count` fields that `accepts` approves.
std::vector<std::string> find_entry(
    const Machine& machine, const char* file, std::size_t count,
    const std::function<bool(const std::vector<std::string>&)>& accepts) {
  std::istringstream lines(machine.read(file).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields = split_fields(line);
    if (fields.size() >= count && accepts(fields)) return fields;
  }
  return {};
}

std::optional<Account> account_of(const Machine& machine, const std::vector<std::string>& entry) {
  if (entry.empty()) return std::nullopt;
  const auto uid = account_number(entry[2]);
  const auto gid = account_number(entry[3]);
  if (!uid || !gid) return std::nullopt;
  Account account{entry[0], *uid, {*gid}};
  find_entry(machine, "/etc/group", 4, [&](const std::vector<std::string>& group) {
    for (const std::string_view member : split_words(group[3], ",")) {
      const auto number = account_number(group[2]);
      if (member == account.name && number) account.gids.insert(*number);
    }
    return false;
  });
  return account;
}

}  // namespace

std::optional<Account> find_account(const Machine& machine, std::string_view name) {
  return account_of(machine, find_entry(machine, "/etc/passwd", 4,
                                        [&](const auto& entry) { return entry[0] == name; }));
}

std::optional<Account> find_account(const Machine& machine, uid_t uid) {
  return account_of(machine, find_entry(machine, "/etc/passwd", 4, [&](const auto& entry) {
                      return account_number(entry[2]) == uid;
                    }));
}

std::optional<gid_t> find_group(const Machine& machine, std::string_view name) {
  const auto entry =
      find_entry(machine, "/etc/group", 3, [&](const auto& fields) { return fields[0] == name; });
  return entry.empty() ? std::nullopt : account_number(entry[2]);
}

std::string group_name(const Machine& machine, gid_t gid) {
  const auto entry = find_entry(machine, "/etc/group", 3, [&](const auto& fields) {
    return account_number(fields[2]) == gid;
  });
  return entry.empty() ? std::to_string(gid) : entry[0];
}

bool may_access(const Account& account, const FileFacts& file, mode_t rights) {
  if (account.uid == 0) return true;
  // POSIX: the first matching class decides, even if a later one allows more.
  const unsigned shift = account.uid == file.uid ? 6 : account.gids.contains(file.gid) ? 3 : 0;
  return (file.mode >> shift & rights) == rights;
}

bool may_read_and_write(const Account& account, const FileFacts& file) {
  return may_access(account, file, 06);
}

std::string describe_rights(const Machine& machine, const FileFacts& file) {
  std::string text = S_ISDIR(file.mode) ? "d" : S_ISREG(file.mode) ? "-" : "c";
  for (int bit = 8; bit >= 0; --bit) {
    text += file.mode >> static_cast<unsigned>(bit) & 1U ? "xwr"[bit % 3] : '-';
  }
  const auto owner = find_account(machine, file.uid);
  return text + ' ' + (owner ? owner->name : std::to_string(file.uid)) + ' ' +
         group_name(machine, file.gid);
}

}  // namespace cornerd::tool
