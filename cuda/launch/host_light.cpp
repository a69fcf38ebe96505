// Light tracing in stages on the threads of the host, for one instruction set.

#include "cuda/launch/host_walks.h"

void PLUMBLINE_KERNELS_OF(light)(fast::HostThreads& threads, fast::Needs needs,
                                 const fast::SceneInMemory& scene, const fast::SampleJob& job)
{
    fast::launch_walks<fast::Integrator::light>(threads, needs, scene, job);
}
