// Builds of the trees of surfaces on the threads of the host, for one instruction set.

#include "cuda/launch/host_kernels.h"

void PLUMBLINE_KERNELS_OF(surfaces)(fast::HostThreads& threads, const fast::SurfaceJob& job)
{
    job.result.emplace(job.memory, threads, job.triangles, job.spheres, job.builder);
}
