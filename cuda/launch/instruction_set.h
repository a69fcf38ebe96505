#pragma once

// The instruction sets that the kernels for the host are compiled for, from the same source. All of them
// give the same bits: no operation is fused or approximated. The one exception is `fastmath`.

#include <span>
#include <string_view>

namespace fast {

/// Sets of x86-64 instructions with vectors of 4, 8 and 16 floats: the psABI's levels x86-64,
/// x86-64-v3 and x86-64-v4. On other processors only `baseline` exists, the compiler's default.
/// `fastmath`: the best set of the machine that built the program, with operations fused and reordered
/// as the compiler likes. It measures what exact rounding costs, and gives other bits.
enum class InstructionSet { baseline, avx2, avx512, fastmath };

/// Those with the same bits that this program was built for and this processor has, from the least to
/// the best. Never `fastmath`.
std::span<const InstructionSet> instruction_sets();

/// Whether this program was built with `fastmath` (PLUMBLINE_FAST_MATH_KERNELS in CMake), and this
/// processor has its instructions.
bool has_fast_math();

/// The last of instruction_sets().
InstructionSet best_instruction_set();

/// The name of the enumerator.
std::string_view name_of(InstructionSet set);

} // namespace fast
