#pragma once

// Four floats that are computed with at the same time. On the host they are one vector of the processor
// (by the extension that g++ and clang share, which needs no header and runs on every processor); for
// nvcc, which gives every thread one float at a time anyway, an array.

#include "cuda/parallel/host_device.h"

namespace gpu {

#if defined(__CUDACC__)

struct alignas(16) Lanes { // in memory the same as the other
    float lane[4];

    HD float operator[](int i) const { return lane[i]; }
    HD float& operator[](int i) { return lane[i]; }
};

HD inline Lanes all_lanes(float x)
{
    return {{x, x, x, x}};
}

HD inline Lanes operator-(const Lanes& a, const Lanes& b)
{
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]}};
}

HD inline Lanes operator+(const Lanes& a, const Lanes& b)
{
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}};
}

HD inline Lanes operator*(const Lanes& a, const Lanes& b)
{
    return {{a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]}};
}

/// a where a > b, else b: b where one of them is NaN.
HD inline Lanes larger(const Lanes& a, const Lanes& b)
{
    Lanes result;
    for (int i = 0; i < 4; ++i) result[i] = a[i] > b[i] ? a[i] : b[i];
    return result;
}

/// a where a < b, else b: b where one of them is NaN.
HD inline Lanes smaller(const Lanes& a, const Lanes& b)
{
    Lanes result;
    for (int i = 0; i < 4; ++i) result[i] = a[i] < b[i] ? a[i] : b[i];
    return result;
}

#else

using Lanes = float __attribute__((vector_size(16)));

inline Lanes all_lanes(float x)
{
    return Lanes{x, x, x, x};
}

/// a where a > b, else b: b where one of them is NaN.
inline Lanes larger(const Lanes& a, const Lanes& b)
{
    return a > b ? a : b;
}

/// a where a < b, else b: b where one of them is NaN.
inline Lanes smaller(const Lanes& a, const Lanes& b)
{
    return a < b ? a : b;
}

#endif

} // namespace gpu
