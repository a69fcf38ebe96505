// The kernels of Integrator::path, for the threads of the host.

#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/threaded_executor.h"

namespace fast {

template void launch_samples<Integrator::path>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                               const SampleJob&);

} // namespace fast
