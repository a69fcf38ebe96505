#pragma once

// What a scene can do without. A kernel is compiled once for each combination, and what a scene does not
// have costs its kernels nothing: no branch, no register.

#include "images/render_options.h"

namespace fast {

/// A template argument of whatever depends on it. Triangles and Lambertian surfaces are always there.
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

/// Path tracing and light tracing are bidirectional path tracing with some strategies left out.
using images::Integrator;

} // namespace fast
