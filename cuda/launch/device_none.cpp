// Replaces device.cu in a build without nvcc.

#include "cuda/launch/device.h"

namespace fast {

Device find_device()
{
    return {false, "built without nvcc"};
}

std::string describe_device()
{
    return find_device().description;
}

} // namespace fast
