#pragma once

// The integrators that are tested on every scene with a known picture.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace transport_test {

struct NamedIntegrator {
    const char* name;
    ref::Integrator integrator;
    bool light_image; // joins light walks to the eye (t = 1)
    // A costly integrator takes fewer samples, and its test is required to have less power.
    int fewer = 1;
    double weaker = 1.0;

    [[nodiscard]] int samples(int of_the_fastest) const { return std::max(1, of_the_fastest / fewer); }
    [[nodiscard]] double bias(double of_the_fastest) const { return of_the_fastest * weaker; }
};

inline void PrintTo(const NamedIntegrator& named, std::ostream* out)
{
    *out << named.name;
}

/// The integrators that find every path, except that those without `light_image` miss the light image.
inline auto integrators()
{
    return testing::Values(NamedIntegrator{"path", ref::trace_path, false},
                           NamedIntegrator{"bidirectional", ref::trace_bidirectionally, true, 4, 3.0});
}

/// Light tracing: finds only paths whose vertex next to the eye is neither a mirror nor glass.
inline auto light_tracer()
{
    return testing::Values(NamedIntegrator{"light", ref::trace_light, true, 2, 4.0});
}

inline std::string name_of(const testing::TestParamInfo<NamedIntegrator>& info)
{
    return info.param.name;
}

/// The base of tests that run for each integrator; GetParam().integrator is under test.
class OfEveryIntegrator : public testing::TestWithParam<NamedIntegrator> {};

} // namespace transport_test
