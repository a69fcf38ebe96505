// The kernels of Integrator::light, for the threads of the host.

#include "cuda/parallel/threaded_executor.h"
#include "cuda/transport/launch_samples.h"

namespace gpu {

template void launch_samples<Integrator::light>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                                const SampleJob&);

} // namespace gpu
