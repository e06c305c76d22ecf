// SPDX-License-Identifier: MIT
#pragma once

#include <sys/resource.h>

#include <cerrno>
#include <string>

namespace cornerd::drivers {

/// What to add to the words of an errno: the limit of open files and the way out where that is
/// reached, else nothing.
inline std::string open_files_hint(int error) {
  if (error == ENFILE) return ", of all processes: raise the sysctl fs.file-max";
  if (error != EMFILE) return {};
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  return ", of at most " + std::to_string(limit.rlim_cur) +
         " in this process: raise `ulimit -n`, or LimitNOFILE= of its unit";
}

}  // namespace cornerd::drivers
