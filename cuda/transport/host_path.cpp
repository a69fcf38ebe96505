// The kernels of Integrator::path, for the threads of the host.

#include "cuda/parallel/threaded_executor.h"
#include "cuda/transport/launch_samples.h"

namespace gpu {

template void launch_samples<Integrator::path>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                               const SampleJob&);

} // namespace gpu
