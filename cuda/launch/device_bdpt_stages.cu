// The kernels of the stages of Integrator::bdpt, for a GPU.

#include "cuda/launch/launch_stages.h"
#include "cuda/parallel/executor.cuh"
#include "cuda/stages/trace_rays.h"

namespace fast {

template void launch_samples<Integrator::bdpt>(StagedExecutor<CudaExecutor>&, Needs,
                                               const SceneInMemory&, const SampleJob&);

} // namespace fast
