#pragma once

// The reference as an images::Renderer (images/renderer.h): batches of samples, tiles of pixels,
// threads over tiles.

#include "images/render_options.h"
#include "images/renderer.h"
#include "ref/transport/world.h"
#include "scenes/scene.h"

#include <memory>

namespace ref {

/// The function for an integrator's name.
Integrator integrator_of(images::Integrator name);

/// Renders `world`, which must outlive the renderer, with any function that is an integrator; the
/// integrator named in the options is ignored. The batches depend only on world, integrator, options
/// and seed, not on the number of `threads`. Throws the exceptions of images::check. A batch throws
/// those of the integrator.
std::unique_ptr<images::Renderer> renderer(const World& world, Integrator integrator,
                                           const images::RenderOptions& options, unsigned threads = 1);

/// The same for a scene, which must have a camera and must outlive the renderer. See World.
std::unique_ptr<images::Renderer> renderer(const scenes::Scene& scene, int width, int height,
                                           const images::RenderOptions& options, unsigned threads = 1,
                                           const BuildOptions& tree = Builder::sah_leaf);

} // namespace ref
