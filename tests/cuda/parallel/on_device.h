#pragma once

// Tests that need a GPU.

#include "cuda/launch/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

namespace cuda_test {

/// Whether tests that need a GPU can run; found out once.
inline const fast::Device& found_device()
{
    static const fast::Device device = fast::find_device();
    return device;
}

/// Whether the present test shall go on. Where there is no usable GPU it is skipped, with the reason. On
/// a machine that is meant to have one, PLUMBLINE_REQUIRE_GPU=1 makes it fail instead: a skip could go
/// unnoticed.
inline void skip_without_device()
{
    if (found_device().usable) return;
    const char* const required = std::getenv("PLUMBLINE_REQUIRE_GPU");
    if (required != nullptr && std::string_view(required) == "1")
        FAIL() << "PLUMBLINE_REQUIRE_GPU is 1, but: " << found_device().description;
    GTEST_SKIP() << found_device().description;
}

/// A fixture for tests that need a GPU.
class OnDevice : public testing::Test {
protected:
    void SetUp() override { skip_without_device(); }
};

} // namespace cuda_test
