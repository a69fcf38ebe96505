#pragma once

// The instruction sets that the kernels for the host are compiled for, from the same source. All of them
// give the same bits: no operation is fused or approximated.

#include <span>
#include <string_view>

namespace fast {

/// Sets of x86-64 instructions with vectors of 4, 8 and 16 floats: the psABI's levels x86-64,
/// x86-64-v3 and x86-64-v4. On other processors only `baseline` exists, the compiler's default.
enum class InstructionSet { baseline, avx2, avx512 };

/// Those that this program was built for and this processor has, from the least to the best.
std::span<const InstructionSet> instruction_sets();

/// The last of them.
InstructionSet best_instruction_set();

/// "baseline", "avx2" or "avx512".
std::string_view name_of(InstructionSet set);

} // namespace fast
