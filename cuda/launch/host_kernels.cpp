#include "cuda/launch/host_kernels.h"

#include <utility>

namespace fast {

namespace {

/// A function of these parameters, by instruction set.
template <class... Parameters>
struct BySet {
    using Function = void(Parameters...);
    Function* baseline;
    Function* avx2;
    Function* avx512;
    Function* fastmath;

    [[nodiscard]] Function& operator[](InstructionSet set) const
    {
        switch (set) {
        case InstructionSet::baseline:
            return *baseline;
        case InstructionSet::avx2:
            return *avx2;
        case InstructionSet::avx512:
            return *avx512;
        case InstructionSet::fastmath:
            break;
        }
        return *fastmath;
    }
};
using SampleKernels = BySet<HostThreads&, Needs, const SceneInMemory&, const SampleJob&>;
using SurfaceKernels = BySet<HostThreads&, const SurfaceJob&>;

// Null for sets that are not compiled.
#if defined(PLUMBLINE_INSTRUCTION_SETS)
#define PLUMBLINE_VECTOR_KERNELS(name) plumbline_kernels_avx2_##name, plumbline_kernels_avx512_##name
#else
#define PLUMBLINE_VECTOR_KERNELS(name) nullptr, nullptr
#endif
#if defined(PLUMBLINE_FAST_MATH_SET)
#define PLUMBLINE_FAST_MATH_KERNEL(name) plumbline_kernels_fastmath_##name
#else
#define PLUMBLINE_FAST_MATH_KERNEL(name) nullptr
#endif
#define PLUMBLINE_KERNELS_BY_SET(name)                                                                  \
    plumbline_kernels_baseline_##name, PLUMBLINE_VECTOR_KERNELS(name), PLUMBLINE_FAST_MATH_KERNEL(name)

} // namespace

template <>
void launch_samples<Integrator::path>(HostThreads& executor, Needs needs, const SceneInMemory& scene,
                                      const SampleJob& job)
{
    constexpr SampleKernels by_set{PLUMBLINE_KERNELS_BY_SET(path)};
    by_set[executor.instructions](executor, needs, scene, job);
}

template <>
void launch_samples<Integrator::bdpt>(HostThreads& executor, Needs needs, const SceneInMemory& scene,
                                      const SampleJob& job)
{
    constexpr SampleKernels by_set{PLUMBLINE_KERNELS_BY_SET(bdpt)};
    by_set[executor.instructions](executor, needs, scene, job);
}

template <>
void launch_samples<Integrator::light>(HostThreads& executor, Needs needs, const SceneInMemory& scene,
                                       const SampleJob& job)
{
    constexpr SampleKernels by_set{PLUMBLINE_KERNELS_BY_SET(light)};
    by_set[executor.instructions](executor, needs, scene, job);
}

SurfaceTree surface_tree(Memory& memory, HostThreads& executor, std::span<const Triangle> triangles,
                         std::span<const Sphere> spheres, TreeBuilder builder)
{
    constexpr SurfaceKernels by_set{PLUMBLINE_KERNELS_BY_SET(surfaces)};
    const InstructionSet set = executor.instructions == InstructionSet::fastmath ? best_instruction_set()
                                                                                 : executor.instructions;
    std::optional<SurfaceTree> result;
    by_set[set](executor, {memory, triangles, spheres, builder, result});
    return std::move(*result);
}

} // namespace fast
