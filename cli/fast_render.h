#pragma once

// `plumbline render --device host|cuda`: the fast path where the reference would render.

#include "cli/render_options.h"
#include "images/strategy_sheet.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace gpu {
class Renderer;
}

namespace cli {

/// Sums of layers over batches.
class LayerSums {
public:
    void add(const images::Strategies& batch, std::uint32_t samples);
    /// The means of those strategies that found anything at all.
    [[nodiscard]] images::Strategies means() const;

private:
    images::Strategies sums_;
    std::uint64_t samples_ = 0;
};

/// What renders for these options, which are for --device host or cuda. Throws std::runtime_error where
/// there is no such device, gpu::OutOfMemory, std::invalid_argument.
std::unique_ptr<gpu::Renderer> fast_renderer(const RenderCommand& options, const scenes::Scene& scene);

/// The batch of that number alone, as ref::render_batch; its `kept` and `batch` are not called. Adds to
/// `layers`, if there are any.
std::optional<images::Image> render_batch(gpu::Renderer& renderer, const RenderCommand& options,
                                          std::uint64_t number, const ref::Monitor& monitor,
                                          LayerSums* layers = nullptr);

/// Adds batches to `film` until it holds all, as ref::render does.
bool render(gpu::Renderer& renderer, const RenderCommand& options, images::Film& film,
            const ref::Monitor& monitor, LayerSums& layers);

} // namespace cli
