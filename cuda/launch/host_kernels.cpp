#include "cuda/launch/host_kernels.h"

namespace fast {

namespace {

using Kernels = void(HostThreads&, Needs, const SceneInMemory&, const SampleJob&);

/// Of one integrator, by instruction set.
struct KernelsBySet {
    Kernels* baseline;
    Kernels* avx2;
    Kernels* avx512;
    Kernels* fastmath;

    void operator()(HostThreads& executor, Needs needs, const SceneInMemory& scene,
                    const SampleJob& job) const
    {
        switch (executor.instructions) {
        case InstructionSet::baseline:
            baseline(executor, needs, scene, job);
            break;
        case InstructionSet::avx2:
            avx2(executor, needs, scene, job);
            break;
        case InstructionSet::avx512:
            avx512(executor, needs, scene, job);
            break;
        case InstructionSet::fastmath:
            fastmath(executor, needs, scene, job);
            break;
        }
    }
};

// Null for sets that are not compiled.
#if defined(PLUMBLINE_INSTRUCTION_SETS)
#define PLUMBLINE_VECTOR_KERNELS(integrator)                                                            \
    plumbline_kernels_avx2_##integrator, plumbline_kernels_avx512_##integrator
#else
#define PLUMBLINE_VECTOR_KERNELS(integrator) nullptr, nullptr
#endif
#if defined(PLUMBLINE_FAST_MATH_SET)
#define PLUMBLINE_FAST_MATH_KERNEL(integrator) plumbline_kernels_fastmath_##integrator
#else
#define PLUMBLINE_FAST_MATH_KERNEL(integrator) nullptr
#endif
#define PLUMBLINE_KERNELS_BY_SET(integrator)                                                            \
    KernelsBySet                                                                                        \
    {                                                                                                   \
        plumbline_kernels_baseline_##integrator, PLUMBLINE_VECTOR_KERNELS(integrator),                  \
            PLUMBLINE_FAST_MATH_KERNEL(integrator)                                                      \
    }

} // namespace

template <>
void launch_samples<Integrator::path>(HostThreads& executor, Needs needs, const SceneInMemory& scene,
                                      const SampleJob& job)
{
    PLUMBLINE_KERNELS_BY_SET(path)(executor, needs, scene, job);
}

template <>
void launch_samples<Integrator::bdpt>(HostThreads& executor, Needs needs, const SceneInMemory& scene,
                                      const SampleJob& job)
{
    PLUMBLINE_KERNELS_BY_SET(bdpt)(executor, needs, scene, job);
}

template <>
void launch_samples<Integrator::light>(HostThreads& executor, Needs needs, const SceneInMemory& scene,
                                       const SampleJob& job)
{
    PLUMBLINE_KERNELS_BY_SET(light)(executor, needs, scene, job);
}

} // namespace fast
