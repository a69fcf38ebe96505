#pragma once

// Arithmetic for truths: sixty decimal digits, with a range of exponents that no double leaves. A
// double converts to it exactly, and a few operations err by less than 1e-55.

#include "scenes/scene.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>

namespace extremes {

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                            boost::multiprecision::et_off>;

struct ExactVec3 {
    Exact x, y, z;

    ExactVec3() = default;
    ExactVec3(Exact x_, Exact y_, Exact z_) : x(std::move(x_)), y(std::move(y_)), z(std::move(z_)) {}
    explicit ExactVec3(const scenes::Vec3& v) : x(v.x), y(v.y), z(v.z) {}
};

inline ExactVec3 operator+(const ExactVec3& a, const ExactVec3& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline ExactVec3 operator-(const ExactVec3& a, const ExactVec3& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline ExactVec3 operator*(const Exact& s, const ExactVec3& v)
{
    return {s * v.x, s * v.y, s * v.z};
}
inline Exact dot(const ExactVec3& a, const ExactVec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline ExactVec3 cross(const ExactVec3& a, const ExactVec3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Exact length(const ExactVec3& v)
{
    return sqrt(dot(v, v));
}

inline scenes::Vec3 in_doubles(const ExactVec3& v)
{
    return {v.x.convert_to<double>(), v.y.convert_to<double>(), v.z.convert_to<double>()};
}

/// `v`, which must not be 0, scaled to unit length and rounded.
inline scenes::Vec3 rounded_unit(const ExactVec3& v)
{
    return in_doubles((1 / length(v)) * v);
}

/// |computed - truth| / |truth|, rounded to double. `truth` must not be 0.
inline double relative_error(double computed, const Exact& truth)
{
    return abs((Exact(computed) - truth) / truth).convert_to<double>();
}

} // namespace extremes
