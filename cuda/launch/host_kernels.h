#pragma once

// The kernels for the threads of the host, compiled in host_path.cpp, host_light.cpp and
// host_bdpt.cpp.

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
