#pragma once

// One batch of a render: tiles of pixels, threads over tiles, and sums in a fixed order.

#include "images/renderer.h"
#include "ref/transport/world.h"

#include <cstdint>
#include <optional>

namespace ref {

/// Renders batch `number`: the samples number * batch_size to (number + 1) * batch_size - 1 of every
/// pixel. Its bits depend on world, integrator and options, and not on the number of `threads`. None if
/// `monitor` stopped it. Throws the exceptions of the integrator.
std::optional<images::Batch> sample_batch(const World& world, Integrator integrator,
                                          const images::RenderOptions& options, std::uint64_t number,
                                          unsigned threads, const images::Monitor& monitor);

} // namespace ref
