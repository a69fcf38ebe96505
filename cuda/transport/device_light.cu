// The kernels of Integrator::light, for a GPU.

#include "cuda/parallel/executor.cuh"
#include "cuda/transport/launch_samples.h"

namespace gpu {

template void launch_samples<Integrator::light>(CudaExecutor&, Needs, const SceneInMemory&,
                                                const SampleJob&);

} // namespace gpu
