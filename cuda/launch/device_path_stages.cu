// The kernels of the stages of Integrator::path, for a GPU.

#include "cuda/launch/launch_stages.h"
#include "cuda/parallel/executor.cuh"
#include "cuda/stages/trace_rays.h"

namespace fast {

template void launch_samples<Integrator::path>(StagedExecutor<CudaExecutor>&, Needs,
                                               const SceneInMemory&, const SampleJob&);

} // namespace fast
