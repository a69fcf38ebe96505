#pragma once

// Tests that need a GPU.

#include "cuda/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

namespace cuda_test {

/// A fixture whose tests are skipped, with the reason, where there is no usable GPU. On a machine that
/// is meant to have one, PLUMBLINE_REQUIRE_GPU=1 makes them fail instead: a skip could go unnoticed.
class OnDevice : public testing::Test {
protected:
    void SetUp() override
    {
        const gpu::Device device = gpu::find_device();
        if (device.usable) return;
        const char* const required = std::getenv("PLUMBLINE_REQUIRE_GPU");
        if (required != nullptr && std::string_view(required) == "1")
            FAIL() << "PLUMBLINE_REQUIRE_GPU is 1, but: " << device.description;
        GTEST_SKIP() << device.description;
    }
};

} // namespace cuda_test
