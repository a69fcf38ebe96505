#include "extremes/light/small_render.h"

#include "cuda/launch/renderer.h"
#include "ref/transport/renderer.h"

#include <memory>

namespace extremes {

namespace {

std::unique_ptr<images::Renderer> renderer_of(Wing wing, const scenes::Scene& scene, int size,
                                              const images::RenderOptions& options)
{
    if (wing == Wing::ref) return ref::renderer(scene, size, size, options);
    if (wing == Wing::host) return fast::host_renderer(scene, size, size, options, 1);
    return fast::device_renderer(scene, size, size, options);
}

} // namespace

images::Image small_render(Wing wing, const scenes::Scene& scene, int size,
                           const images::RenderOptions& options)
{
    images::Image image = renderer_of(wing, scene, size, options)->render_batch(0).value().mean;
    for (images::Rgb& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = static_cast<double>(static_cast<float>(pixel[channel]));
    return image;
}

} // namespace extremes
