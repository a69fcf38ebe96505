// The kernels of Integrator::light, for a GPU.

#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/executor.cuh"

namespace fast {

template void launch_samples<Integrator::light>(CudaExecutor&, Needs, const SceneInMemory&,
                                                const SampleJob&);

} // namespace fast
