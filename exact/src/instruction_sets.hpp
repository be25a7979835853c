// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

// HEXACT_FOR_EACH_INSTRUCTION_SET before a hot function: compiled for the oldest x86-64 processors and for those since
// 2013 (AVX2), the right one being chosen when the program starts. Without contraction both give the same bits.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define HEXACT_FOR_EACH_INSTRUCTION_SET __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define HEXACT_FOR_EACH_INSTRUCTION_SET
#endif
