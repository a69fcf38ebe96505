#pragma once

// The integrators that every scene with a known picture is tried on.

#include "ref/transport/path_tracer.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace tests {

struct NamedIntegrator {
    const char* name;
    ref::Integrator integrator;
    bool light_image; // joins walks from the light to the eye (t = 1)
};

inline void PrintTo(const NamedIntegrator& named, std::ostream* out)
{
    *out << named.name;
}

/// Those that find every path that can be found, but for what `light_image` says.
inline auto integrators()
{
    return testing::Values(NamedIntegrator{"path", ref::trace_path, false});
}

inline std::string name_of(const testing::TestParamInfo<NamedIntegrator>& info)
{
    return info.param.name;
}

/// A test of each of them: GetParam().integrator is under test.
class OfEveryIntegrator : public testing::TestWithParam<NamedIntegrator> {};

} // namespace tests
