// SPDX-License-Identifier: MIT
#include "instruction_classes.hpp"

namespace cornerd::cost {
namespace {

using enum InstructionClass;

constexpr std::uint32_t bits(std::uint32_t word, int low, int count) {
  return (word >> low) & ((1u << count) - 1);
}

/// Coprocessors 10 and 11 are the floating-point unit, in single and in double precision.
bool is_for_vfp(std::uint32_t word) { return bits(word, 9, 3) == 5; }

/// ARM DDI 0406, A7.5: data processing of the floating-point unit.
InstructionClass classify_arithmetic(std::uint32_t word) {
  const bool is_double = bits(word, 8, 1) == 1;
  switch (bits(word, 23, 1) << 2 | bits(word, 20, 2)) {
    case 2:  // VMUL, VNMUL
      return is_double ? kMultiplyDouble : kMultiplyFloat;
    case 3:  // VADD, VSUB
      return kAdd;
    case 4:  // VDIV
      return is_double ? kDivideDouble : kDivideFloat;
    case 7: {
      const std::uint32_t operation = bits(word, 16, 4);
      const std::uint32_t variant = bits(word, 6, 2);
      if ((variant & 1) == 0) return kCompare;  // VMOV #
      if (operation == 1 && variant == 3) return is_double ? kDivideDouble : kDivideFloat;  // VSQRT
      const bool converts = operation == 2 || operation == 3 || operation >= 7;
      return converts ? kConvert : kCompare;
    }
    default:  // VMLA, VMLS, VNMLA, VNMLS
      return is_double ? kAccumulateDouble : kAccumulateFloat;
  }
}

/// The encodings that ARM and Thumb-2 share: the top byte without ARM's condition.
InstructionClass classify_coprocessor(std::uint32_t word) {
  if (!is_for_vfp(word)) return kInteger;
  const bool to_core = bits(word, 20, 1) == 1;
  if (bits(word, 24, 4) == 0xE) {
    if (bits(word, 4, 1) == 0) return classify_arithmetic(word);
    return to_core ? kToCore : kVectorMove;
  }
  const bool moves_two = bits(word, 21, 4) == 2;  // VMOV of two core registers
  return moves_two && to_core ? kToCore : kVectorMove;
}

InstructionClass classify_thumb(std::uint32_t word) {
  switch (bits(word, 24, 8)) {
    case 0xEF:
    case 0xFF:
      return kNeon;
    case 0xF9:
      return bits(word, 20, 1) == 0 ? kVectorMove : kInteger;
    case 0xEC:
    case 0xED:
    case 0xEE:
      return classify_coprocessor(word);
    default:
      return kInteger;
  }
}

InstructionClass classify_arm(std::uint32_t word) {
  constexpr std::uint32_t kUnconditional = 0xF;
  const std::uint32_t group = bits(word, 24, 4);
  if (bits(word, 28, 4) == kUnconditional) {
    if (group == 2 || group == 3) return kNeon;
    return group == 4 && bits(word, 20, 1) == 0 ? kVectorMove : kInteger;
  }
  return group >= 0xC && group <= 0xE ? classify_coprocessor(word) : kInteger;
}

}  // namespace

InstructionClass classify(std::span<const std::uint8_t> bytes, bool thumb) {
  if (bytes.size() != 4) return kInteger;
  const auto half = [&](std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at] | bytes[at + 1] << 8);
  };
  return thumb ? classify_thumb(half(0) << 16 | half(2)) : classify_arm(half(2) << 16 | half(0));
}

}  // namespace cornerd::cost
