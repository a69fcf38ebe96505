#pragma once

// The kernels that are compiled for the threads of the host, in host_path.cpp and its like.

#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/threaded_executor.h"

namespace fast {

extern template void launch_samples<Integrator::path>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::bdpt>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::light>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                                       const SampleJob&);

} // namespace fast
