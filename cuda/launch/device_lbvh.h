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

/// Builds trees with the kernels of lbvh.h on the first GPU, on its own stream. All errors of CUDA are
/// thrown as std::runtime_error.
class DeviceLbvh {
public:
    /// For up to `capacity` primitives and codes of 30 or 63 bits. Throws std::runtime_error if there
    /// is no GPU or if the program was built without nvcc, and OutOfMemory.
    DeviceLbvh(std::uint32_t capacity, int code_bits);
    ~DeviceLbvh();
    DeviceLbvh(const DeviceLbvh&) = delete;
    DeviceLbvh& operator=(const DeviceLbvh&) = delete;

    /// Copies the boxes to the device and queues the build.
    void build(std::span<const Aabb> boxes);

    /// Builds again from the boxes of the last `build`, launched as one graph that was captured from
    /// the stages. This works only because no stage of a build waits for the device.
    void build_as_graph();

    /// Builds again, and waits: the milliseconds of each stage (stage_names) between events on the
    /// stream.
    std::array<float, 5> time_stages();

    /// Builds the better tree of hploc.h over the leaves of the last build, and copies it to the host.
    /// It has no codes.
    [[nodiscard]] BuiltTree download_clustered();

    /// Waits for the build, and copies the tree to the host. Throws std::invalid_argument that names
    /// the first box that is empty or not finite.
    [[nodiscard]] BuiltTree download() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// The closest hits of rays with surfaces (surfaces.h) on the first GPU. Throws the exceptions of
/// DeviceLbvh, std::invalid_argument for more than 2^32 - 1 rays, and std::invalid_argument that names
/// the first primitive that is not finite.
std::vector<Hit> intersect_on_device(std::span<const Triangle> triangles,
                                     std::span<const Sphere> spheres, std::span<const Ray> rays);

} // namespace fast
