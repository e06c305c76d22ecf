// SPDX-License-Identifier: MIT
// A plugin of QEMU's user mode emulator: counts the instructions of an ARM program between calls of
// its functions cost_begin_NAME and cost_end_NAME, by class. Windows may lie in each other.
//
//   qemu-arm -plugin libcounter.so,out=FILE[,functions=NAME] PROGRAM
//
// FILE gets a line for each NAME: window NAME COUNT, then median and maximum of instructions and of
// cycles, then the classes' mean numbers. With functions=NAME, lines of the functions that ran
// inside that window: function SYMBOL INSTRUCTIONS CYCLES, the mean of each window. The last line
// is the whole program: total INSTRUCTIONS CYCLES.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "instruction_classes.hpp"
#include "qemu_plugin.hpp"

namespace cornerd::cost {
namespace {

struct Counts {
  std::array<std::uint64_t, kClasses> of_class{};

  void add(const Counts& other) {
    for (std::size_t i = 0; i < kClasses; ++i) of_class[i] += other.of_class[i];
  }
  Counts since(const Counts& earlier) const {
    Counts difference = *this;
    for (std::size_t i = 0; i < kClasses; ++i) difference.of_class[i] -= earlier.of_class[i];
    return difference;
  }
  std::uint64_t instructions() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : of_class) sum += count;
    return sum;
  }
  std::uint64_t cycles() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < kClasses; ++i) sum += of_class[i] * kClassCosts[i].cycles;
    return sum;
  }
};

struct Window {
  Counts at_begin;
  bool is_open = false;
  std::vector<Counts> finished;
};

/// Of straight-line code: what running it once adds, and what it begins or ends.
struct Block {
  Counts counts;
  Counts* function = nullptr;
  Window* begins = nullptr;
  Window* ends = nullptr;
};

/// Windows count one thread, that of the markers. The total counts all; two that run at once may
/// lose a block.
struct Counter {
  Counts total;
  std::map<std::string, Window, std::less<>> windows;
  std::map<std::string, Counts, std::less<>> functions;
  std::vector<std::unique_ptr<Block>> blocks;
  std::string out;
  const Window* profiled = nullptr;
};

Counter& counter() {
  static Counter instance;
  return instance;
}

std::uint16_t first_half(const qemu_plugin_insn* instruction) {
  std::uint16_t half = 0;
  std::memcpy(&half, qemu_plugin_insn_data(instruction), sizeof half);
  return half;
}

/// Thumb instructions of four bytes begin with a half word that is at least this.
constexpr std::uint16_t kFirstOfFour = 0xE800;

/// The processor's state is not told to plugins. Thumb code has instructions of two bytes, ARM code
/// none. (QEMU's own word for an instruction's size is not to be trusted at the end of a page:
/// there it has looked ahead and counts what it saw.)
bool is_thumb(const qemu_plugin_tb* block) {
  if (qemu_plugin_tb_vaddr(block) % 4 != 0) return true;
  const std::size_t count = qemu_plugin_tb_n_insns(block);
  for (std::size_t i = 0; i < count; ++i) {
    const qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(block, i);
    const bool is_last = i + 1 == count;
    const std::size_t size = is_last
                                 ? qemu_plugin_insn_size(instruction)
                                 : qemu_plugin_insn_vaddr(qemu_plugin_tb_get_insn(block, i + 1)) -
                                       qemu_plugin_insn_vaddr(instruction);
    if (size == 2) return true;
    if (first_half(instruction) < kFirstOfFour) return false;
  }
  return true;
}

Window* window_of(std::string_view symbol, std::string_view prefix) {
  if (!symbol.starts_with(prefix)) return nullptr;
  return &counter().windows[std::string(symbol.substr(prefix.size()))];
}

void on_execution(unsigned int /*vcpu*/, void* data) {
  const Block& block = *static_cast<const Block*>(data);
  Counter& all = counter();
  if (block.ends != nullptr && block.ends->is_open) {
    block.ends->finished.push_back(all.total.since(block.ends->at_begin));
    block.ends->is_open = false;
  }
  all.total.add(block.counts);
  if (all.profiled != nullptr && all.profiled->is_open) block.function->add(block.counts);
  if (block.begins != nullptr) {
    block.begins->at_begin = all.total;
    block.begins->is_open = true;
  }
}

void on_translation(qemu_plugin_id_t /*id*/, qemu_plugin_tb* translated) {
  auto block = std::make_unique<Block>();
  const bool thumb = is_thumb(translated);
  for (std::size_t i = 0; i < qemu_plugin_tb_n_insns(translated); ++i) {
    const qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(translated, i);
    const bool is_short = thumb && first_half(instruction) < kFirstOfFour;
    const std::span bytes(static_cast<const std::uint8_t*>(qemu_plugin_insn_data(instruction)),
                          is_short ? 2u : 4u);
    ++block->counts.of_class[static_cast<std::size_t>(classify(bytes, thumb))];
  }
  const char* name = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(translated, 0));
  const std::string_view symbol = name == nullptr ? "?" : name;
  block->function = &counter().functions[std::string(symbol)];
  block->begins = window_of(symbol, "cost_begin_");
  block->ends = window_of(symbol, "cost_end_");
  qemu_plugin_register_vcpu_tb_exec_cb(translated, on_execution, QEMU_PLUGIN_CB_NO_REGS,
                                       block.get());
  counter().blocks.push_back(std::move(block));
}

void write_window(std::FILE* file, const std::string& name, const Window& window) {
  std::vector<std::uint64_t> instructions;
  std::vector<std::uint64_t> cycles;
  Counts sum;
  for (const Counts& counts : window.finished) {
    instructions.push_back(counts.instructions());
    cycles.push_back(counts.cycles());
    sum.add(counts);
  }
  std::sort(instructions.begin(), instructions.end());
  std::sort(cycles.begin(), cycles.end());
  const std::size_t count = window.finished.size();
  std::fprintf(file, "window %s %zu %llu %llu %llu %llu", name.c_str(), count,
               static_cast<unsigned long long>(instructions[count / 2]),
               static_cast<unsigned long long>(instructions.back()),
               static_cast<unsigned long long>(cycles[count / 2]),
               static_cast<unsigned long long>(cycles.back()));
  for (std::size_t i = 0; i < kClasses; ++i) {
    std::fprintf(file, " %s=%.0f", kClassCosts[i].name.data(),
                 static_cast<double>(sum.of_class[i]) / static_cast<double>(count));
  }
  std::fputc('\n', file);
}

void write_results(qemu_plugin_id_t /*id*/, void* /*data*/) {
  const Counter& all = counter();
  std::FILE* file = std::fopen(all.out.c_str(), "w");
  if (file == nullptr) {
    std::perror(all.out.c_str());
    return;
  }
  for (const auto& [name, window] : all.windows) {
    if (!window.finished.empty()) write_window(file, name, window);
  }
  if (all.profiled != nullptr && !all.profiled->finished.empty()) {
    const auto count = static_cast<double>(all.profiled->finished.size());
    for (const auto& [name, counts] : all.functions) {
      if (counts.instructions() == 0) continue;
      std::fprintf(file, "function %s %.0f %.0f\n", name.c_str(),
                   static_cast<double>(counts.instructions()) / count,
                   static_cast<double>(counts.cycles()) / count);
    }
  }
  std::fprintf(file, "total %llu %llu\n", static_cast<unsigned long long>(all.total.instructions()),
               static_cast<unsigned long long>(all.total.cycles()));
  std::fclose(file);
}

}  // namespace
}  // namespace cornerd::cost

extern "C" {

[[gnu::visibility("default")]] int qemu_plugin_version = 1;

[[gnu::visibility("default")]] int qemu_plugin_install(qemu_plugin_id_t id,
                                                       const qemu_info_t* /*info*/, int argc,
                                                       char** argv) {
  using namespace cornerd::cost;
  for (const std::string_view option : std::span(argv, static_cast<std::size_t>(argc))) {
    if (option.starts_with("out=")) {
      counter().out = option.substr(4);
    } else if (option.starts_with("functions=")) {
      counter().profiled = &counter().windows[std::string(option.substr(10))];
    } else {
      std::fprintf(stderr, "counter: unknown option %s\n", option.data());
      return -1;
    }
  }
  if (counter().out.empty()) {
    std::fputs("counter: out=FILE is missing\n", stderr);
    return -1;
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
  qemu_plugin_register_atexit_cb(id, write_results, nullptr);
  return 0;
}

}  // extern "C"
