#pragma once

// From samples to a picture: batches of samples, tiles of pixels, threads over tiles.

#include "images/dropped.h"
#include "images/film.h"
#include "ref/transport/strategy_layers.h"
#include "ref/transport/world.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace ref {

struct RenderOptions {
    PathOptions path;
    std::uint64_t batches = 64;   // that the film is to hold in the end
    std::uint32_t batch_size = 4; // samples per pixel of a batch
    unsigned threads = 1;
};

/// How a caller watches a render and stops it. Any of them may be empty. `progress` and `stop` are
/// called from any of the render's threads, `progress` from one at a time.
struct Monitor {
    std::function<void(double done)> progress = {}; // batches done, with the part of the present one
    std::function<bool()> stop = {};                // asked between tiles: true ends the render soon
    std::function<void(const images::Film&)> kept =
        {}; // after each batch, with the film as it stands then
    std::function<void(const images::Image&)> batch = {}; // each batch's mean, before `kept`
    /// After a batch of which contributions that are not finite were left out. Empty: then that is an
    /// error.
    std::function<void(const images::Dropped&)> dropped = {};
};

/// Adds batches to `film`, which may come from an earlier, shorter render, until it holds as many as
/// asked for or `monitor` says stop; an unfinished batch is dropped. Returns whether it is complete.
/// The film depends on scene, options and seed alone: not on the number of threads, nor on where the
/// render was interrupted. A contribution that is not finite is left out of film and layers, and
/// reported to `monitor`. `layers`, if there are any, receive the same batches strategy by strategy.
/// Throws std::invalid_argument if film, layers and camera differ in size, std::runtime_error for
/// contributions that are not finite if `monitor` does not take the report.
bool render(const World& world, Integrator integrator, const RenderOptions& options, images::Film& film,
            const Monitor& monitor = {}, StrategyLayers* layers = nullptr);

/// The mean per pixel of the batch `number` alone: what render adds to a film that holds that many
/// batches. None if `monitor` said stop; of it `progress`, `stop` and `dropped` are called.
std::optional<images::Image> render_batch(const World& world, Integrator integrator,
                                          const RenderOptions& options, std::uint64_t number,
                                          const Monitor& monitor = {});

} // namespace ref
