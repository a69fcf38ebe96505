#include "extremes/exact.h"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <new>
#include <type_traits>

namespace extremes {

using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                             boost::multiprecision::et_off>;

struct Exact::Access {
    static Number& number(Exact& a) { return *std::launder(reinterpret_cast<Number*>(a.room_)); }
    static const Number& number(const Exact& a)
    {
        return *std::launder(reinterpret_cast<const Number*>(a.room_));
    }
    template <class T>
    static void make(Exact& a, const T& value)
    {
        static_assert(sizeof(Number) <= sizeof(a.room_) && alignof(Number) <= alignof(Exact));
        static_assert(std::is_trivially_destructible_v<Number>);
        new (a.room_) Number(value);
    }
    static Exact from(const Number& value)
    {
        Exact a;
        number(a) = value;
        return a;
    }
};

// room_ is filled by make().
// NOLINTBEGIN(cppcoreguidelines-pro-type-member-init)
Exact::Exact(int value)
{
    Access::make(*this, value);
}
Exact::Exact(double value)
{
    Access::make(*this, value);
}
Exact::Exact(std::uint64_t value)
{
    Access::make(*this, value);
}
Exact::Exact(const Exact& other)
{
    Access::make(*this, Access::number(other));
}
// NOLINTEND(cppcoreguidelines-pro-type-member-init)

Exact& Exact::operator=(const Exact& other)
{
    if (this != &other) Access::number(*this) = Access::number(other);
    return *this;
}
Exact& Exact::operator+=(const Exact& other)
{
    Access::number(*this) += Access::number(other);
    return *this;
}
Exact& Exact::operator-=(const Exact& other)
{
    Access::number(*this) -= Access::number(other);
    return *this;
}
Exact& Exact::operator*=(const Exact& other)
{
    Access::number(*this) *= Access::number(other);
    return *this;
}
Exact& Exact::operator/=(const Exact& other)
{
    Access::number(*this) /= Access::number(other);
    return *this;
}

int compare(const Exact& a, const Exact& b)
{
    const Number& x = Exact::Access::number(a);
    const Number& y = Exact::Access::number(b);
    return x < y ? -1 : x > y ? 1 : 0;
}
Exact abs(const Exact& a)
{
    return Exact::Access::from(boost::multiprecision::abs(Exact::Access::number(a)));
}
Exact sqrt(const Exact& a)
{
    return Exact::Access::from(boost::multiprecision::sqrt(Exact::Access::number(a)));
}
Exact tan(const Exact& a)
{
    return Exact::Access::from(boost::multiprecision::tan(Exact::Access::number(a)));
}
double Exact::to_double() const
{
    return Access::number(*this).convert_to<double>();
}

Exact Exact::pi()
{
    return Access::from(boost::math::constants::pi<Number>());
}

ExactVec3 operator+(const ExactVec3& a, const ExactVec3& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
ExactVec3 operator-(const ExactVec3& a, const ExactVec3& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
ExactVec3 operator*(const Exact& s, const ExactVec3& v)
{
    return {s * v.x, s * v.y, s * v.z};
}
Exact dot(const ExactVec3& a, const ExactVec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
ExactVec3 cross(const ExactVec3& a, const ExactVec3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Exact length(const ExactVec3& v)
{
    return sqrt(dot(v, v));
}

scenes::Vec3 in_doubles(const ExactVec3& v)
{
    return {v.x.to_double(), v.y.to_double(), v.z.to_double()};
}

scenes::Vec3 rounded_unit(const ExactVec3& v)
{
    return in_doubles((1 / length(v)) * v);
}

double relative_error(double computed, const Exact& truth)
{
    return abs((Exact(computed) - truth) / truth).to_double();
}

} // namespace extremes
