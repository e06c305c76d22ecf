// SPDX-License-Identifier: MIT
// What an instruction costs on a Cortex-A8, roughly: enough to compare two versions of a program.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace cornerd::cost {

/// Kinds of instructions that differ in what they cost.
enum class InstructionClass : std::uint8_t {
  kInteger,
  kNeon,
  kVectorMove,  ///< loads and stores of the floating-point registers, and moves into them
  kToCore,      ///< from a floating-point register to an integer one or to the flags
  kAdd,
  kMultiplyFloat,
  kMultiplyDouble,
  kAccumulateFloat,
  kAccumulateDouble,
  kDivideFloat,  ///< and square roots
  kDivideDouble,
  kCompare,  ///< and negation, absolute value, constants
  kConvert,
};

struct ClassCost {
  std::string_view name;
  unsigned cycles;
};

/// In the order of the classes. The Cortex-A8's scalar floating-point unit is not pipelined: an
/// operation holds it for its whole latency, here the longest that GCC's model of the processor
/// has for it. Integer and NEON instructions are counted flat; caches, dual issue and branches are
/// not looked at.
inline constexpr std::array<ClassCost, 13> kClassCosts = {{{"integer", 1},
                                                           {"neon", 2},
                                                           {"vector-move", 1},
                                                           {"to-core", 20},
                                                           {"add", 10},
                                                           {"multiply-float", 12},
                                                           {"multiply-double", 17},
                                                           {"accumulate-float", 21},
                                                           {"accumulate-double", 26},
                                                           {"divide-float", 37},
                                                           {"divide-double", 65},
                                                           {"compare", 4},
                                                           {"convert", 7}}};
inline constexpr std::size_t kClasses = kClassCosts.size();

/// `bytes`: one instruction, 2 or 4 bytes; `thumb`: of the Thumb-2 set rather than ARM's.
InstructionClass classify(std::span<const std::uint8_t> bytes, bool thumb);

}  // namespace cornerd::cost
