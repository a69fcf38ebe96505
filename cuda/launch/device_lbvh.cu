#include "cuda/launch/device_lbvh.h"

#include "cuda/launch/on_device.cuh"
#include "cuda/trees/hploc.h"
#include "cuda/trees/lbvh.h"
#include "cuda/trees/surfaces.h"

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace fast {

namespace {

/// A CUDA event: a point in time on a stream.
class StreamEvent {
public:
    StreamEvent() { check(cudaEventCreate(&event_)); }
    ~StreamEvent() { cudaEventDestroy(event_); }
    StreamEvent(const StreamEvent&) = delete;
    StreamEvent& operator=(const StreamEvent&) = delete;
    void record(cudaStream_t stream) const { check(cudaEventRecord(event_, stream)); }
    [[nodiscard]] float milliseconds_since(const StreamEvent& start) const
    {
        float milliseconds = 0;
        check(cudaEventSynchronize(event_));
        check(cudaEventElapsedTime(&milliseconds, start.event_, event_));
        return milliseconds;
    }

private:
    cudaEvent_t event_{};
};

using EitherTree = std::variant<Lbvh<std::uint32_t>, Lbvh<std::uint64_t>>;

EitherTree tree_for(Memory& memory, const CudaExecutor& executor, std::uint32_t capacity, int code_bits)
{
    if (code_bits == fast::code_bits<std::uint32_t>)
        return EitherTree(std::in_place_index<0>, memory, executor, capacity);
    return EitherTree(std::in_place_index<1>, memory, executor, capacity);
}

} // namespace

struct DeviceLbvh::Parts {
    Parts(std::uint32_t capacity, int code_bits)
        : tree(tree_for(memory, executor, capacity, code_bits)), boxes(memory, capacity)
    {}
    /// The boxes of the last build, on the device.
    [[nodiscard]] std::span<const Aabb> current() const { return boxes.first(count); }
    template <class T>
    [[nodiscard]] std::vector<std::remove_const_t<T>> read(std::span<T> device)
    {
        std::vector<std::remove_const_t<T>> host(device.size());
        if (!host.empty()) memory.read(host.data(), device.data(), device.size_bytes());
        return host;
    }

    Stream stream;
    DeviceMemory memory{stream.get()};
    CudaExecutor executor{stream.get()};
    EitherTree tree;
    Buffer<Aabb> boxes;
    std::size_t count = 0;
};

DeviceLbvh::DeviceLbvh(std::uint32_t capacity, int code_bits)
{
    require_device();
    parts_ = std::make_unique<Parts>(capacity, code_bits);
}

DeviceLbvh::~DeviceLbvh() = default;

void DeviceLbvh::build(std::span<const Aabb> boxes)
{
    parts_->boxes.write(boxes);
    parts_->count = boxes.size();
    std::visit([&](auto& tree) { tree.build(parts_->executor, parts_->current()); }, parts_->tree);
}

void DeviceLbvh::build_as_graph()
{
    const cudaStream_t stream = parts_->stream.get();
    cudaGraph_t graph{};
    cudaGraphExec_t ready{};
    check(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal));
    std::visit([&](auto& tree) { tree.build(parts_->executor, parts_->current()); }, parts_->tree);
    check(cudaStreamEndCapture(stream, &graph));
    check(cudaGraphInstantiate(&ready, graph, 0));
    check(cudaGraphLaunch(ready, stream));
    check(cudaStreamSynchronize(stream));
    check(cudaGraphExecDestroy(ready));
    check(cudaGraphDestroy(graph));
}

std::array<float, 5> DeviceLbvh::time_stages()
{
    std::array<StreamEvent, 6> events;
    events[0].record(parts_->stream.get());
    const auto finished = [&](Stage stage) {
        events[static_cast<std::size_t>(stage) + 1].record(parts_->stream.get());
    };
    std::visit([&](auto& tree) { tree.build(parts_->executor, parts_->current(), finished); },
               parts_->tree);
    std::array<float, 5> milliseconds{};
    for (std::size_t i = 0; i < 5; ++i) milliseconds[i] = events[i + 1].milliseconds_since(events[i]);
    return milliseconds;
}

BuiltTree DeviceLbvh::download_clustered()
{
    return std::visit(
        [&](auto& tree) {
            Hploc clustered(parts_->memory, tree.primitive_count());
            clustered.build(parts_->executor, parts_->current(), tree.order());
            return BuiltTree{parts_->read(clustered.nodes()),
                             parts_->read(clustered.leaf_links()),
                             parts_->read(tree.primitives()),
                             {}};
        },
        parts_->tree);
}

BuiltTree DeviceLbvh::download() const
{
    return std::visit(
        [&](const auto& tree) {
            throw_if_rejected(tree.first_rejected(), parts_->read(parts_->current()));
            const auto codes = parts_->read(tree.codes());
            return BuiltTree{parts_->read(tree.nodes()),
                             parts_->read(tree.leaf_links()),
                             parts_->read(tree.primitives()),
                             {codes.begin(), codes.end()}};
        },
        parts_->tree);
}

namespace {

/// The same kernel with and without spheres.
template <bool has_spheres>
void intersect_rays(CudaExecutor& executor, const SurfaceTree& tree, const Buffer<Ray>& rays,
                    Buffer<Hit>& hits)
{
    executor(static_cast<std::uint32_t>(rays.size()),
             IntersectRays<Surfaces<has_spheres>>{tree.view<has_spheres>(), rays.all(), hits.all()});
}

} // namespace

std::vector<Hit> intersect_on_device(std::span<const Triangle> triangles,
                                     std::span<const Sphere> spheres, std::span<const Ray> rays)
{
    require_device();
    if (rays.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument(std::to_string(rays.size()) + " rays at once: at most 2^32 - 1");
    return on_device([&](DeviceMemory& memory, CudaExecutor& executor) {
        const SurfaceTree tree(memory, executor, triangles, spheres);
        const Buffer<Ray> asked(memory, rays);
        Buffer<Hit> hits(memory, rays.size());
        if (tree.has_spheres())
            intersect_rays<true>(executor, tree, asked, hits);
        else
            intersect_rays<false>(executor, tree, asked, hits);
        return hits.read(rays.size());
    });
}

} // namespace fast
