#pragma once

// The interface of renderers, and the loop that fills a film. ref/ and cuda/ implement `Renderer` once
// each; a reader's own integrator can as well.

#include "images/dropped.h"
#include "images/film.h"
#include "images/render_options.h"
#include "images/strategies.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace images {

/// Throws std::invalid_argument for a path of no edge, for roulette before the first bounce, for
/// pictures of strategies of paths that are longer than most_edges_of_strategies, and the errors of
/// expect_families. For renderers to call.
void check(const RenderOptions& options);

/// Functions by which a caller follows and stops a render. Each may be empty. `progress` and `stop` may
/// be called from any of the render's threads, `progress` from one at a time.
struct Monitor {
    std::function<void(double done)> progress = {}; // batches done, with the part of the present one
    std::function<bool()> stop = {}; // called from time to time; true ends the render soon
    /// Called after a batch from which contributions were left out because they are not finite. If it is
    /// empty, such a batch is an error.
    std::function<void(const Dropped&)> dropped = {};
};

/// A batch: the mean of a fixed number of samples per pixel (RenderOptions::batch_size).
struct Batch {
    Image mean; // radiance (W m^-2 sr^-1) per pixel
    /// If RenderOptions::strategies is set: per pixel and strategy the sum of its contributions over the
    /// samples of the batch. A strategy without contributions may be missing.
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
    /// independent. None if monitor.stop returned true. Throws std::runtime_error for contributions
    /// that are not finite if monitor.dropped is empty, and the errors of the renderer.
    std::optional<Batch> render_batch(std::uint64_t number, const Monitor& monitor = {});

private:
    /// The same. It counts contributions that are not finite and does not call Monitor::dropped.
    virtual std::optional<Batch> make_batch(std::uint64_t number, const Monitor& monitor) = 0;
};

/// Renders the batches of numbers `first` <= number < `end` in this order, and calls done(batch) for
/// each. False if monitor.stop returned true: then the unfinished batch is lost.
bool render_batches(Renderer& renderer, std::uint64_t first, std::uint64_t end, const Monitor& monitor,
                    const std::function<void(const Batch&)>& done);

/// Adds batches to `film`, which may come from an earlier, shorter render, until its range ends at `end`
/// or monitor.stop returns true. Returns whether it is complete. The film does not depend on where it
/// was interrupted. Calls added(batch), if it is not empty, after the film has the batch. Throws
/// std::invalid_argument if film and renderer differ in size; see Renderer::render_batch.
bool fill(Film& film, std::uint64_t end, Renderer& renderer, const Monitor& monitor = {},
          const std::function<void(const Batch&)>& added = {});

} // namespace images
