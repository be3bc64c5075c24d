// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pds
{

/** \brief Instruction sets for which the vector kernels are compiled; all give the same bits. */
enum class InstructionSet
{
  baseline,
  avx2,
  avx512
};

/** \brief The best set that this processor has. */
[[nodiscard]] InstructionSet best_instruction_set();

}  // namespace pds

// A kernel is one always_inline function of plain loops, which compilers turn into vector code, and a wrapper with a
// target attribute for each instruction set.
#if defined(__clang__)
#define PDS_AVX512 "avx512f,avx512vl,avx512bw,avx512dq"
#else
#define PDS_AVX512 "avx512f,avx512vl,avx512bw,avx512dq,prefer-vector-width=512"
#endif
