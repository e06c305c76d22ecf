// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

/// A user of the machine and its groups.
struct Account {
  std::string name;
  uid_t uid = 0;
  std::set<gid_t> gids;
};

/// Reads /etc/passwd and /etc/group.
std::optional<Account> find_account(const Machine& machine, std::string_view name);
std::optional<Account> find_account(const Machine& machine, uid_t uid);

std::optional<gid_t> find_group(const Machine& machine, std::string_view name);
/// The group's name, or its number if it has none.
std::string group_name(const Machine& machine, gid_t gid);

/// True if the file's mode gives the account all of the rights (4 read, 2 write, 1 search).
bool may_access(const Account& account, const FileFacts& file, mode_t rights);
bool may_read_and_write(const Account& account, const FileFacts& file);

/// "crw-rw---- root dialout"
std::string describe_rights(const Machine& machine, const FileFacts& file);

}  // namespace cornerd::tool
