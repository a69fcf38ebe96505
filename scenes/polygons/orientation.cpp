// The determinant is computed in doubles first. Where rounding could have changed its sign, it is
// computed again as an exact sum of doubles, an expansion. Both, and the bound on the rounding error,
// are from: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", Discrete & Computational Geometry 18 (1997), sec. 2 and 4.1.

#include "scenes/polygons/orientation.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace scenes::polygons {
namespace {

int sign(double value)
{
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// A sum of doubles without rounding. Its value is the sum of all components, and its sign is that of
/// the last component that is not zero.
class Expansion {
public:
    void add(double value)
    {
        for (std::size_t i = 0; i < size_; ++i) {
            const double sum = value + components_[i];
            const double part = sum - value;
            components_[i] = (value - (sum - part)) + (components_[i] - part); // what rounding lost
            value = sum;
        }
        components_[size_++] = value;
    }

    void add_product(double a, double b)
    {
        const double product = a * b;
        add(std::fma(a, b, -product)); // what rounding lost
        add(product);
    }

    [[nodiscard]] int sign() const
    {
        for (std::size_t i = size_; i > 0; --i)
            if (components_[i - 1] != 0) return polygons::sign(components_[i - 1]);
        return 0;
    }

private:
    std::array<double, 12> components_{}; // of six products
    std::size_t size_ = 0;
};

int exact_orientation(const Point& a, const Point& b, const Point& c)
{
    Expansion sum;
    sum.add_product(a.x, b.y);
    sum.add_product(-a.y, b.x);
    sum.add_product(b.x, c.y);
    sum.add_product(-b.y, c.x);
    sum.add_product(c.x, a.y);
    sum.add_product(-c.y, a.x);
    return sum.sign();
}

} // namespace

int orientation(const Point& a, const Point& b, const Point& c)
{
    constexpr double half_ulp = 0x1p-53;
    constexpr double relative_error = (3 + 16 * half_ulp) * half_ulp;
    const double left = (a.x - c.x) * (b.y - c.y);
    const double right = (a.y - c.y) * (b.x - c.x);
    const double determinant = left - right;
    if (std::abs(determinant) > relative_error * (std::abs(left) + std::abs(right)))
        return sign(determinant);
    return exact_orientation(a, b, c);
}

bool is_between(const Point& a, const Point& b, const Point& c)
{
    // On a line that is not vertical, points are in the order of x; on a vertical one of y.
    if (a.x != c.x) return (a.x < b.x && b.x < c.x) || (c.x < b.x && b.x < a.x);
    return (a.y < b.y && b.y < c.y) || (c.y < b.y && b.y < a.y);
}

bool is_in_wedge(const Point& previous, const Point& at, const Point& next, const Point& target)
{
    const bool left_of_next = orientation(at, next, target) > 0;
    const bool right_of_previous = orientation(previous, at, target) > 0;
    const int turn = orientation(previous, at, next);
    if (turn > 0) return left_of_next && right_of_previous;
    if (turn < 0) {
        // More than half a turn: everything outside the closed wedge on the other side.
        return !(orientation(at, next, target) <= 0 && orientation(previous, at, target) <= 0);
    }
    // Straight on: the half plane on the left. Straight back: everything but that one direction.
    if (is_between(previous, at, next)) return left_of_next;
    return orientation(at, next, target) != 0 || is_between(next, at, target);
}

} // namespace scenes::polygons
