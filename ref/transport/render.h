#pragma once

// The reference behind the one door (images/renderer.h): batches of samples, tiles of pixels, threads
// over tiles.

#include "images/render_options.h"
#include "images/renderer.h"
#include "ref/transport/world.h"
#include "scenes/scene.h"

#include <memory>

namespace ref {

/// The integrator of that name.
Integrator integrator_of(images::Integrator name);

/// Renders `world`, which must outlive the renderer, by any function that is an integrator; that of the
/// options is not used. The batches depend on world, integrator, options and seed alone, not on the
/// number of `threads`. Throws what images::check does. A batch throws what the integrator throws.
std::unique_ptr<images::Renderer> renderer(const World& world, Integrator integrator,
                                           const images::RenderOptions& options, unsigned threads = 1);

/// The same for a scene, which must have a camera and must outlive the renderer. See World.
std::unique_ptr<images::Renderer> renderer(const scenes::Scene& scene, int width, int height,
                                           const images::RenderOptions& options, unsigned threads = 1,
                                           Builder builder = Builder::sah_leaf);

} // namespace ref
