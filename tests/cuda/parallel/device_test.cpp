#include "cuda/launch/device.h"
#include "tests/cuda/parallel/on_device.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using parallel_test::OnDevice;

TEST(Device, IsDescribedInOneLineWhetherThereIsOneOrNot)
{
    const fast::Device device = fast::find_device();
    EXPECT_EQ(device.description.find('\n'), std::string::npos);
    EXPECT_EQ(fast::describe_device(), device.description);
    if (!device.usable) {
        EXPECT_TRUE(device.description == "built without nvcc" ||
                    device.description.find("no CUDA device found: ") != std::string::npos ||
                    device.description.find("cannot be used: ") != std::string::npos)
            << device.description;
    }
}

TEST_F(OnDevice, TheDeviceRunsOurMachineCode)
{
    const fast::Device device = fast::find_device();
    EXPECT_TRUE(device.usable) << device.description;
    EXPECT_NE(device.description.find("sm_"), std::string::npos) << device.description;
}

} // namespace
