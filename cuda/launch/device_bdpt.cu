// The kernels of Integrator::bdpt, for a GPU.

#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/executor.cuh"

namespace fast {

template void launch_samples<Integrator::bdpt>(CudaExecutor&, Needs, const SceneInMemory&,
                                               const SampleJob&);

} // namespace fast
