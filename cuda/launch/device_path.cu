// The kernels of Integrator::path, for a GPU.

#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/executor.cuh"

namespace fast {

template void launch_samples<Integrator::path>(CudaExecutor&, Needs, const SceneInMemory&,
                                               const SampleJob&);

} // namespace fast
