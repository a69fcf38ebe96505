#pragma once

#include "cuda/scene/scene_arrays.h"
#include "cuda/transport/probes.h"

#include <span>
#include <vector>

namespace fast {

// Each function computes the kernel of its name in probes.h for all probes, by one thread of the host.
// Those that end with _on_device do so on the first GPU; they throw std::runtime_error if there is none,
// or if the program was built without nvcc, and OutOfMemory.

std::vector<ProbedGlass> probe_glass(std::span<const GlassProbe> probes);
std::vector<ProbedGlass> probe_glass_on_device(std::span<const GlassProbe> probes);

std::vector<ProbedCamera> probe_camera(std::span<const CameraProbe> probes);
std::vector<ProbedCamera> probe_camera_on_device(std::span<const CameraProbe> probes);

/// Throws the exceptions of SurfaceTree as well.
std::vector<float> probe_irradiance(const SceneArrays& arrays, std::span<const PointProbe> probes);
std::vector<float> probe_irradiance_on_device(const SceneArrays& arrays,
                                              std::span<const PointProbe> probes);

} // namespace fast
