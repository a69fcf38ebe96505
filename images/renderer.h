#pragma once

// The one door to rendering: what a renderer must do, and the one loop that fills a film by it. Both
// wings implement `Renderer` once; so can a reader's own integrator.

#include "images/dropped.h"
#include "images/film.h"
#include "images/render_options.h"
#include "images/strategies.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace images {

/// Throws std::invalid_argument for a path of no edge, and for pictures of strategies of paths that are
/// longer than most_edges_of_strategies. For renderers to call.
void check(const RenderOptions& options);

/// How a caller watches a render and stops it. Any of them may be empty. `progress` and `stop` may be
/// called from any of the render's threads, `progress` from one at a time.
struct Monitor {
    std::function<void(double done)> progress = {}; // batches done, with the part of the present one
    std::function<bool()> stop = {};                // asked now and then: true ends the render soon
    /// After a batch of which contributions that are not finite were left out. Empty: then that is an
    /// error.
    std::function<void(const Dropped&)> dropped = {};
};

/// A batch: the mean of a fixed number of samples per pixel (RenderOptions::batch_size).
struct Batch {
    Image mean; // radiance (W m^-2 sr^-1) per pixel
    /// If RenderOptions::strategies asks for them: per pixel the sum over the batch's samples of what
    /// each strategy found. One that found nothing may be left out.
    Strategies strategies;
    Dropped dropped; // contributions that are not finite, which are in neither
};

/// A scene made ready for rendering by one integrator.
class Renderer {
public:
    Renderer() = default;
    virtual ~Renderer() = default;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// The batch of that number: its samples per pixel are those from number * batch_size on. The same
    /// number gives the same batch, whatever was rendered before; batches of different numbers are
    /// independent. None if `monitor` said stop. Throws std::runtime_error for contributions that are
    /// not finite if `monitor` does not take the report; what else it throws, the renderer says.
    std::optional<Batch> render_batch(std::uint64_t number, const Monitor& monitor = {});

private:
    /// The same, but it only counts what is not finite: Monitor::dropped is not for it to call.
    virtual std::optional<Batch> make_batch(std::uint64_t number, const Monitor& monitor) = 0;
};

/// Renders the batches of numbers `first` <= number < `end` in this order, and calls done(batch) for
/// each. False if `monitor` said stop: the batch in the making is lost then.
bool render_batches(Renderer& renderer, std::uint64_t first, std::uint64_t end, const Monitor& monitor,
                    const std::function<void(const Batch&)>& done);

/// Adds batches to `film`, which may come from an earlier, shorter render, until it holds `batches` or
/// `monitor` says stop. Returns whether it is complete. The film depends on what is rendered alone, not
/// on where it was interrupted. Calls added(batch), if there is such a function, when the film has the
/// batch. Throws std::invalid_argument if film and renderer differ in size; see Renderer::render_batch.
bool fill(Film& film, std::uint64_t batches, Renderer& renderer, const Monitor& monitor = {},
          const std::function<void(const Batch&)>& added = {});

} // namespace images
