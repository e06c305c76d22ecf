// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "tool/doctor/machine.hpp"

namespace cornerd::tool {

/// A user of the machine and all groups that it is in.
struct Account {
  std::string name;
  uid_t uid = 0;
  std::set<gid_t> gids;
};

/// By /etc/passwd and /etc/group.
std::optional<Account> find_account(const Machine& machine, std::string_view name);
std::optional<Account> find_account(const Machine& machine, uid_t uid);

std::optional<gid_t> find_group(const Machine& machine, std::string_view name);
/// Its number where it has no name.
std::string group_name(const Machine& machine, gid_t gid);

/// True where the account has all of the rights (4 to read, 2 to write, 1 to search) to a file,
/// going by its mode alone.
bool may_access(const Account& account, const FileFacts& file, mode_t rights);
bool may_read_and_write(const Account& account, const FileFacts& file);

/// "crw-rw---- root dialout"
std::string describe_rights(const Machine& machine, const FileFacts& file);

}  // namespace cornerd::tool
