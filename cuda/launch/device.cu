#include "cuda/launch/device.h"

#include <cuda_runtime.h>

namespace fast {

namespace {

/// An empty kernel: if it runs, the machine code fits the device.
__global__ void do_nothing() {}

/// What a user should know about the device code of this program, if anything.
#ifdef PLUMBLINE_CUDA_QUICK
constexpr const char* remark = ", device code compiled quickly: slow";
#else
constexpr const char* remark = "";
#endif

/// CUDA counts versions as 1000 * major + 10 * minor.
std::string version(int number)
{
    return std::to_string(number / 1000) + "." + std::to_string(number % 1000 / 10);
}

Device no_device(cudaError_t reason)
{
    return {false, "built with nvcc " + std::to_string(__CUDACC_VER_MAJOR__) + "." +
                       std::to_string(__CUDACC_VER_MINOR__) + remark +
                       ", no CUDA device found: " + cudaGetErrorString(reason)};
}

/// An attribute of device 0; 0 if it is not available.
int attribute(cudaDeviceAttr which)
{
    int value = 0;
    return cudaDeviceGetAttribute(&value, which, 0) == cudaSuccess ? value : 0;
}

} // namespace

Device find_device()
{
    int count = 0;
    if (const cudaError_t error = cudaGetDeviceCount(&count); error != cudaSuccess)
        return no_device(error);
    if (count == 0) return no_device(cudaErrorNoDevice);
    cudaDeviceProp properties{};
    if (const cudaError_t error = cudaGetDeviceProperties(&properties, 0); error != cudaSuccess)
        return no_device(error);
    int driver = 0;
    if (const cudaError_t error = cudaDriverGetVersion(&driver); error != cudaSuccess)
        return no_device(error);

    std::string description = std::string(properties.name) + ", sm_" + std::to_string(properties.major) +
                              std::to_string(properties.minor) + ", driver for CUDA " + version(driver) +
                              ", " + std::to_string(properties.totalGlobalMem >> 30) + " GiB" + remark;
    do_nothing<<<1, 1>>>();
    cudaError_t error = cudaGetLastError(); // of the launch
    if (error == cudaSuccess) error = cudaDeviceSynchronize();
    if (error != cudaSuccess)
        return {false, description + ", cannot be used: " + cudaGetErrorString(error)};
    // Two transfers per clock cycle; the clock rate is in kHz.
    const double clock = 1e3 * attribute(cudaDevAttrMemoryClockRate);
    const double bus_bytes = attribute(cudaDevAttrGlobalMemoryBusWidth) / 8.0;
    return {true, description, 2 * clock * bus_bytes,
            static_cast<std::size_t>(attribute(cudaDevAttrL2CacheSize))};
}

std::string describe_device()
{
    return find_device().description;
}

} // namespace fast
