// Replaces device_renderer.cu in a build without nvcc.

#include "cuda/launch/device.h"
#include "cuda/launch/renderer.h"

#include <stdexcept>

namespace fast {

std::unique_ptr<Renderer> device_renderer(const scenes::Scene& /*scene*/, int /*width*/, int /*height*/,
                                          const images::RenderOptions& /*options*/,
                                          const RendererOptions& /*choices*/)
{
    throw std::runtime_error(find_device().description);
}

} // namespace fast
