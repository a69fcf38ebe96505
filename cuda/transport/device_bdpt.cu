// The kernels of Integrator::bdpt, for a GPU.

#include "cuda/parallel/executor.cuh"
#include "cuda/transport/launch_samples.h"

namespace gpu {

template void launch_samples<Integrator::bdpt>(CudaExecutor&, Needs, const SceneInMemory&,
                                               const SampleJob&);

} // namespace gpu
