// SPDX-License-Identifier: MIT
#include "instruction_classes.hpp"

#include <gtest/gtest.h>

#include <array>

namespace cornerd::cost {
namespace {

using enum InstructionClass;

struct Encoded {
  const char* text;
  std::uint32_t word;  ///< as a disassembler prints it
  InstructionClass expected;
};

InstructionClass classify_word(std::uint32_t word, bool thumb) {
  // Thumb-2 stores the half that it prints first first.
  const std::uint32_t stored = thumb ? word << 16 | word >> 16 : word;
  std::array<std::uint8_t, 4> bytes;
  for (int i = 0; i < 4; ++i) bytes[static_cast<std::size_t>(i)] = (stored >> (8 * i)) & 0xFF;
  return classify(bytes, thumb);
}

TEST(InstructionClasses, ThumbInstruction_IsOfItsClass) {
  const Encoded all[] = {
      {"add.w r0, r1, r2", 0xeb010002, kInteger},
      {"mul r0, r1, r2", 0xfb01f002, kInteger},
      {"ldr.w r0, [r1, #4]", 0xf8d10004, kInteger},
      {"pld [r0]", 0xf890f000, kInteger},
      {"vadd.f64 d0, d1, d2", 0xee310b02, kAdd},
      {"vadd.f32 s0, s1, s2", 0xee300a81, kAdd},
      {"vmul.f64 d0, d1, d2", 0xee210b02, kMultiplyDouble},
      {"vmul.f32 s0, s1, s2", 0xee200a81, kMultiplyFloat},
      {"vmla.f64 d0, d1, d2", 0xee010b02, kAccumulateDouble},
      {"vnmls.f64 d0, d1, d2", 0xee110b02, kAccumulateDouble},
      {"vmla.f32 s0, s1, s2", 0xee000a81, kAccumulateFloat},
      {"vdiv.f64 d0, d1, d2", 0xee810b02, kDivideDouble},
      {"vsqrt.f64 d0, d1", 0xeeb10bc1, kDivideDouble},
      {"vdiv.f32 s0, s1, s2", 0xee800a81, kDivideFloat},
      {"vcmp.f64 d0, d1", 0xeeb40b41, kCompare},
      {"vneg.f64 d0, d1", 0xeeb10b41, kCompare},
      {"vmov.f64 d0, #1.0", 0xeeb70b00, kCompare},
      {"vcvt.f64.s32 d0, s2", 0xeeb80bc1, kConvert},
      {"vcvt.f64.f32 d0, s2", 0xeeb70ac1, kConvert},
      {"vmrs APSR_nzcv, fpscr", 0xeef1fa10, kToCore},
      {"vmov r0, s0", 0xee100a10, kToCore},
      {"vmov r0, r1, d0", 0xec510b10, kToCore},
      {"vmov s0, r0", 0xee000a10, kVectorMove},
      {"vmov d0, r0, r1", 0xec410b10, kVectorMove},
      {"vldr d0, [r0]", 0xed900b00, kVectorMove},
      {"vpush {d8-d9}", 0xed2d8b04, kVectorMove},
      {"vld1.32 {d0}, [r0]", 0xf920078f, kVectorMove},
      {"vadd.f32 q0, q1, q2", 0xef020d44, kNeon},
      {"vmul.f32 d0, d1, d2", 0xff010d12, kNeon},
  };
  for (const Encoded& one : all) {
    EXPECT_EQ(classify_word(one.word, true), one.expected) << one.text;
  }
}

TEST(InstructionClasses, ArmInstruction_IsOfItsClass) {
  const Encoded all[] = {
      {"add r0, r1, r2", 0xe0810002, kInteger},
      {"vadd.f64 d0, d1, d2", 0xee310b02, kAdd},
      {"vmulne.f64 d0, d1, d2", 0x1e210b02, kMultiplyDouble},
      {"vldr d0, [r0]", 0xed900b00, kVectorMove},
      {"vmrs APSR_nzcv, fpscr", 0xeef1fa10, kToCore},
      {"vmov r0, r1, d0", 0xec510b10, kToCore},
      {"vld1.32 {d0}, [r0]", 0xf420078f, kVectorMove},
      {"vadd.f32 q0, q1, q2", 0xf2020d44, kNeon},
  };
  for (const Encoded& one : all) {
    EXPECT_EQ(classify_word(one.word, false), one.expected) << one.text;
  }
}

TEST(InstructionClasses, ShortInstruction_IsInteger) {
  const std::array<std::uint8_t, 2> adds = {0x88, 0x18};
  EXPECT_EQ(classify(adds, true), kInteger);
}

}  // namespace
}  // namespace cornerd::cost
