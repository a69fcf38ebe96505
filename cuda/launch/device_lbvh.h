#pragma once

// Trees on a GPU, for code that is not compiled by nvcc.

#include "cuda/trees/node.h"
#include "cuda/trees/sphere.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace fast {

/// A tree (node.h) copied to the host.
struct BuiltTree {
    std::vector<Node> nodes;
    std::vector<std::uint32_t> leaf_links;
    std::vector<std::uint32_t> primitives; // by leaf
    std::vector<std::uint64_t> codes;      // by leaf
};

/// Builds trees with the kernels of lbvh.h on the first GPU, on a stream of its own. All errors of CUDA
/// are thrown as std::runtime_error.
class DeviceLbvh {
public:
    /// Room for `capacity` primitives and codes of 30 or 63 bits. Throws std::runtime_error where there
    /// is no GPU or no nvcc was there to compile for it, and OutOfMemory where it does not fit.
    DeviceLbvh(std::uint32_t capacity, int code_bits);
    ~DeviceLbvh();
    DeviceLbvh(const DeviceLbvh&) = delete;
    DeviceLbvh& operator=(const DeviceLbvh&) = delete;

    /// Copies the boxes to the device and queues the build.
    void build(std::span<const Aabb> boxes);

    /// Builds again from the boxes of the last `build`, launched as one graph that was captured from the
    /// stages. Shows that nothing in a build waits for the device.
    void build_as_graph();

    /// Builds again, and waits: the milliseconds of each stage (stage_names) between events on the
    /// stream.
    std::array<float, 5> time_stages();

    /// Builds the better tree of hploc.h over the leaves of the last build, and copies it. It has no
    /// codes.
    [[nodiscard]] BuiltTree download_clustered();

    /// Waits for the build, and copies the tree. Throws std::invalid_argument that names the first box
    /// that is none.
    [[nodiscard]] BuiltTree download() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// The closest hits of rays with surfaces (surfaces.h) on the first GPU. Throws as DeviceLbvh does, and
/// std::invalid_argument for more than 2^32 - 1 rays and for a primitive that is not finite, by the
/// number of the first.
std::vector<Hit> intersect_on_device(std::span<const Triangle> triangles,
                                     std::span<const Sphere> spheres, std::span<const Ray> rays);

} // namespace fast
