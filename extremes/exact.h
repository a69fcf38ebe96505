#pragma once

// Arithmetic for truths: sixty decimal digits, with a range of exponents that no double leaves. A
// double converts to it exactly, and a few operations err by less than 1e-55.

#include "scenes/scene.h"

#include <cstddef>
#include <cstdint>

namespace extremes {

/// A number of sixty digits: boost::multiprecision::cpp_bin_float<60>. Its headers take seconds to
/// compile, so that only exact.cpp includes them; here is room for one.
class Exact {
public:
    Exact() : Exact(0) {}
    Exact(int value);
    Exact(double value);
    explicit Exact(std::uint64_t value);
    static Exact pi();
    Exact(const Exact& other);
    Exact& operator=(const Exact& other);

    Exact& operator+=(const Exact& other);
    Exact& operator-=(const Exact& other);
    Exact& operator*=(const Exact& other);
    Exact& operator/=(const Exact& other);
    friend Exact operator+(Exact a, const Exact& b) { return a += b; }
    friend Exact operator-(Exact a, const Exact& b) { return a -= b; }
    friend Exact operator*(Exact a, const Exact& b) { return a *= b; }
    friend Exact operator/(Exact a, const Exact& b) { return a /= b; }
    friend Exact operator-(const Exact& a) { return Exact(0) - a; }

    /// -1, 0 or 1, as a is less than, equal to or greater than b.
    friend int compare(const Exact& a, const Exact& b);
    friend bool operator==(const Exact& a, const Exact& b) { return compare(a, b) == 0; }
    friend bool operator<(const Exact& a, const Exact& b) { return compare(a, b) < 0; }
    friend bool operator>(const Exact& a, const Exact& b) { return compare(a, b) > 0; }
    friend bool operator<=(const Exact& a, const Exact& b) { return compare(a, b) <= 0; }
    friend bool operator>=(const Exact& a, const Exact& b) { return compare(a, b) >= 0; }

    friend Exact abs(const Exact& a);
    friend Exact sqrt(const Exact& a);
    friend Exact tan(const Exact& a);
    /// Rounded to nearest.
    [[nodiscard]] double to_double() const;

private:
    struct Access; // to the number in `room_`
    alignas(16) std::byte room_[64];
};

struct ExactVec3 {
    Exact x, y, z;

    ExactVec3() = default;
    ExactVec3(const Exact& x_, const Exact& y_, const Exact& z_) : x(x_), y(y_), z(z_) {}
    explicit ExactVec3(const scenes::Vec3& v) : x(v.x), y(v.y), z(v.z) {}
};

ExactVec3 operator+(const ExactVec3& a, const ExactVec3& b);
ExactVec3 operator-(const ExactVec3& a, const ExactVec3& b);
ExactVec3 operator*(const Exact& s, const ExactVec3& v);
Exact dot(const ExactVec3& a, const ExactVec3& b);
ExactVec3 cross(const ExactVec3& a, const ExactVec3& b);
Exact length(const ExactVec3& v);

scenes::Vec3 in_doubles(const ExactVec3& v);

/// `v`, which must not be 0, scaled to unit length and rounded.
scenes::Vec3 rounded_unit(const ExactVec3& v);

/// |computed - truth| / |truth|, rounded to double. `truth` must not be 0.
double relative_error(double computed, const Exact& truth);

} // namespace extremes
