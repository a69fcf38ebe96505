// The kernels of Integrator::light for the threads of the host, for one instruction set.

#include "cuda/launch/host_kernels.h"

void PLUMBLINE_KERNELS_OF(light)(fast::HostThreads& threads, fast::Needs needs,
                                 const fast::SceneInMemory& scene, const fast::SampleJob& job)
{
    fast::launch_samples<fast::Integrator::light>(static_cast<fast::ThreadedExecutor&>(threads), needs,
                                                  scene, job);
}
