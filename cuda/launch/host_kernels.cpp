#include "cuda/launch/host_kernels.h"

namespace fast {

namespace {

using Kernels = void(HostThreads&, Needs, const SceneInMemory&, const SampleJob&);

/// Of one integrator, by instruction set.
struct KernelsBySet {
    Kernels* baseline;
    Kernels* avx2;
    Kernels* avx512;

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
        }
    }
};

#if defined(PLUMBLINE_INSTRUCTION_SETS)
#define PLUMBLINE_KERNELS_BY_SET(integrator)                                                            \
    KernelsBySet                                                                                        \
    {                                                                                                   \
        plumbline_kernels_baseline_##integrator, plumbline_kernels_avx2_##integrator,                   \
            plumbline_kernels_avx512_##integrator                                                       \
    }
#else
#define PLUMBLINE_KERNELS_BY_SET(integrator)                                                            \
    KernelsBySet                                                                                        \
    {                                                                                                   \
        plumbline_kernels_baseline_##integrator, nullptr, nullptr                                       \
    }
#endif

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
