#pragma once

// Features that a kernel can be compiled without. A feature that a kernel is compiled without costs it
// no branch and no register.

#include "images/render_options.h"

#include <array>

namespace fast {

/// A template argument of the kernels and of all that they call. Triangles and Lambertian surfaces are
/// always supported.
struct Needs {
    bool spheres;            // besides triangles
    bool specular;           // mirrors or glass
    bool other_lights;       // emitters other than triangles
    bool coincident = false; // surfaces that coincide as floats, or nearly do (SceneView::coincident)
    friend constexpr Needs operator|(const Needs& a, const Needs& b)
    {
        return {a.spheres || b.spheres, a.specular || b.specular, a.other_lights || b.other_lights,
                a.coincident || b.coincident};
    }
    friend constexpr bool operator==(const Needs&, const Needs&) = default;
};

/// Of a kernel that can do everything.
constexpr Needs any_needs{true, true, true, true};

/// The combinations that kernels are compiled for; each includes those before it. Each takes as long
/// again to compile, for three integrators and each executor, and no gain of smaller ones was measured
/// (docs/cuda-bdpt.md, section 7).
constexpr std::array compiled_needs = {Needs{}, Needs{true, true, false}, any_needs};

/// The smallest combination in compiled_needs that includes `needs`.
constexpr Needs compiled_for(const Needs& needs)
{
    for (const Needs& compiled : compiled_needs)
        if ((compiled | needs) == compiled) return compiled;
    return any_needs;
}

/// Path tracing and light tracing are bidirectional path tracing with some strategies left out.
using images::Integrator;

} // namespace fast
