// SPDX-License-Identifier: MIT
#include "daemon/realtime.hpp"

#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace cornerd::daemon {
namespace {

#ifdef CORNERD_SANITIZED
/// A sanitizer keeps its own data on each stack: ThreadSanitizer 800 kB.
constexpr std::size_t kStackBytes = 8 * 1024 * 1024;
#else
/// The deepest users are the JSON parser, whose nesting is limited, and the localizer: 60 kB.
constexpr std::size_t kStackBytes = 512 * 1024;
#endif

struct Mapping {
  void* begin = nullptr;
  std::size_t size = 0;
  bool writable = false;
};

/// Readable private mappings of this process. Others belong to devices or are shared.
std::vector<Mapping> mappings() {
  std::vector<Mapping> all;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    unsigned long begin = 0;
    unsigned long end = 0;
    char rights[5] = {};
    if (std::sscanf(line.c_str(), "%lx-%lx %4s", &begin, &end, rights) != 3) continue;
    if (rights[0] != 'r' || rights[3] != 'p' || line.find("[v") != std::string::npos) continue;
    void* const address = reinterpret_cast<void*>(begin);  // NOLINT(performance-no-int-to-ptr)
    all.push_back({address, end - begin, rights[1] == 'w'});
  }
  return all;
}

}  // namespace

void use_small_stacks() {
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return;
  ::pthread_attr_setstacksize(&attributes, kStackBytes);
  ::pthread_setattr_default_np(&attributes);
  ::pthread_attr_destroy(&attributes);
}

int lock_memory() { return ::mlockall(MCL_CURRENT) == 0 ? 0 : errno; }

bool prefault_memory() {
  bool is_known = true;
  for (const Mapping& mapping : mappings()) {
    const int result = ::madvise(mapping.begin, mapping.size,
                                 mapping.writable ? MADV_POPULATE_WRITE : MADV_POPULATE_READ);
    // EINVAL for writable mappings: the kernel does not know MADV_POPULATE_WRITE.
    if (result != 0 && errno == EINVAL && mapping.writable) is_known = false;
  }
  return is_known;
}

std::uint64_t page_faults_of_thread() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return static_cast<std::uint64_t>(usage.ru_minflt) + static_cast<std::uint64_t>(usage.ru_majflt);
}

}  // namespace cornerd::daemon
