// Replaces device_lbvh.cu in a build without nvcc.

#include "cuda/launch/device_lbvh.h"

#include "cuda/launch/device.h"

#include <stdexcept>

namespace fast {

struct DeviceLbvh::Parts {};

DeviceLbvh::DeviceLbvh(std::uint32_t /*capacity*/, int /*code_bits*/)
{
    throw std::runtime_error(describe_device());
}

DeviceLbvh::~DeviceLbvh() = default;

void DeviceLbvh::build(std::span<const Aabb> /*boxes*/) {}

void DeviceLbvh::build_as_graph() {}

std::array<float, 5> DeviceLbvh::time_stages()
{
    return {};
}

BuiltTree DeviceLbvh::download() const
{
    return {};
}

BuiltTree DeviceLbvh::download_clustered()
{
    return {};
}

std::vector<Hit> intersect_on_device(std::span<const Triangle> /*triangles*/,
                                     std::span<const Sphere> /*spheres*/, std::span<const Ray> /*rays*/)
{
    throw std::runtime_error(describe_device());
}

} // namespace fast
