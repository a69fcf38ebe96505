// The kernels of Integrator::path, for a GPU.

#include "cuda/parallel/executor.cuh"
#include "cuda/transport/launch_samples.h"

namespace gpu {

template void launch_samples<Integrator::path>(CudaExecutor&, Needs, const SceneInMemory&,
                                               const SampleJob&);

} // namespace gpu
