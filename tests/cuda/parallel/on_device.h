#pragma once

// Tests that need a GPU.

#include "cuda/launch/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

namespace parallel_test {

/// The GPU, if any; searched for only once.
inline const fast::Device& found_device()
{
    static const fast::Device device = fast::find_device();
    return device;
}

/// Skips the current test, with the reason, if there is no usable GPU. On a machine that should have
/// one, PLUMBLINE_REQUIRE_GPU=1 turns the skip into a failure, since a skip could go unnoticed.
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

} // namespace parallel_test
