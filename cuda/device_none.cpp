// What stands in for device.cu where there is no nvcc.

#include "cuda/device.h"

namespace gpu {

Device find_device()
{
    return {false, "built without nvcc"};
}

std::string describe_device()
{
    return find_device().description;
}

} // namespace gpu
