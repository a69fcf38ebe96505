// What stands in for device_lbvh.cu where there is no nvcc.

#include "cuda/trees/device_lbvh.h"

#include "cuda/device.h"

#include <stdexcept>

namespace gpu {

struct DeviceLbvh::Parts {};

DeviceLbvh::DeviceLbvh(std::uint32_t /*capacity*/, int /*code_bits*/)
{
    throw std::runtime_error(describe_device());
}

DeviceLbvh::~DeviceLbvh() = default;

void DeviceLbvh::build(std::span<const Box> /*boxes*/) {}

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

std::vector<Hit> closest_hits_on_device(std::span<const Triangle> /*triangles*/,
                                        std::span<const Sphere> /*spheres*/,
                                        std::span<const Ray> /*rays*/)
{
    throw std::runtime_error(describe_device());
}

} // namespace gpu
