// The kernels of Integrator::bdpt for the threads of the host, for one instruction set.

#include "cuda/launch/host_kernels.h"

void PLUMBLINE_KERNELS_OF(bdpt)(fast::HostThreads& threads, fast::Needs needs,
                                const fast::SceneInMemory& scene, const fast::SampleJob& job)
{
    fast::launch_samples<fast::Integrator::bdpt>(static_cast<fast::ThreadedExecutor&>(threads), needs,
                                                 scene, job);
}
