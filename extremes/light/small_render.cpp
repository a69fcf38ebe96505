#include "extremes/light/small_render.h"

#include "cuda/launch/renderer.h"
#include "ref/transport/renderer.h"

namespace extremes {

images::Image small_render(Format wing, const scenes::Scene& scene, int size,
                           const images::RenderOptions& options)
{
    const auto renderer = wing == Format::binary64 ? ref::renderer(scene, size, size, options)
                                                   : fast::host_renderer(scene, size, size, options, 1);
    images::Image image = renderer->render_batch(0).value().mean;
    for (images::Rgb& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = static_cast<double>(static_cast<float>(pixel[channel]));
    return image;
}

} // namespace extremes
