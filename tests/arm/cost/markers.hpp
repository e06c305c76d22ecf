// SPDX-License-Identifier: MIT
#pragma once

/// Defines cost_begin_NAME() and cost_end_NAME(): between them the counter counts. They differ, and
/// hide what they do: the compiler must neither fold two of them into one nor leave them out.
#define CORNERD_COST_STAGE(name)                                                         \
  extern "C" [[gnu::noipa]] void cost_begin_##name() { asm volatile("@ begin " #name); } \
  extern "C" [[gnu::noipa]] void cost_end_##name() { asm volatile("@ end " #name); }
