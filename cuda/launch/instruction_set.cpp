#include "cuda/launch/instruction_set.h"

#include <algorithm>
#include <array>

namespace fast {

namespace {

#if defined(PLUMBLINE_INSTRUCTION_SETS)
bool has_avx2()
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
           __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
}

bool has_avx512()
{
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}

std::size_t count_sets()
{
    return has_avx512() ? 3 : has_avx2() ? 2 : 1;
}
#else
std::size_t count_sets()
{
    return 1;
}
#endif

} // namespace

std::span<const InstructionSet> instruction_sets()
{
    static constexpr std::array all{InstructionSet::baseline, InstructionSet::avx2,
                                    InstructionSet::avx512};
    static const std::size_t count = count_sets();
    return std::span(all).first(count);
}

bool has_fast_math()
{
#if defined(PLUMBLINE_FAST_MATH_SET)
    return std::ranges::find(instruction_sets(), InstructionSet::PLUMBLINE_FAST_MATH_SET) !=
           instruction_sets().end();
#else
    return false;
#endif
}

InstructionSet best_instruction_set()
{
    return instruction_sets().back();
}

std::string_view name_of(InstructionSet set)
{
    switch (set) {
    case InstructionSet::baseline:
        return "baseline";
    case InstructionSet::avx2:
        return "avx2";
    case InstructionSet::avx512:
        return "avx512";
    case InstructionSet::fastmath:
        break;
    }
    return "fastmath";
}

} // namespace fast
