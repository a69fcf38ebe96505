#pragma once

// Features that a kernel can be compiled without. Each combination is compiled once, so a feature that a
// scene does not use costs its kernels no branch and no register.

#include "images/render_options.h"

namespace fast {

/// A template argument of the kernels and of all that they call. Triangles and Lambertian surfaces are
/// always supported.
struct Needs {
    bool spheres;      // besides triangles
    bool specular;     // mirrors or glass
    bool other_lights; // emitters other than triangles
    friend constexpr Needs operator|(const Needs& a, const Needs& b)
    {
        return {a.spheres || b.spheres, a.specular || b.specular, a.other_lights || b.other_lights};
    }
    friend constexpr bool operator==(const Needs&, const Needs&) = default;
};

/// Of a kernel that can do everything.
constexpr Needs any_needs{true, true, true};

/// Path tracing and light tracing are bidirectional path tracing with some strategies left out.
using images::Integrator;

} // namespace fast
