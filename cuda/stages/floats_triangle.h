#pragma once

// The intersection of many rays with one triangle: the test of cuda/trees/intersect.h, with the same
// bits.

#include "cuda/parallel/floats_records.h"
#include "cuda/trees/intersect.h"

namespace fast {

namespace detail {

constexpr hn::RepartitionToWide<decltype(float_tag)> double_tag;
constexpr hn::Half<decltype(float_tag)> half_tag;

} // namespace detail

/// As many doubles as Floats has floats.
struct Doubles {
    using Half = hn::Vec<decltype(detail::double_tag)>;
    Half lower, upper;

    Doubles(Half low, Half high) : lower(low), upper(high) {}
    explicit Doubles(const Floats& x)
        : lower(hn::PromoteTo(detail::double_tag, hn::LowerHalf(detail::half_tag, x.v))),
          upper(hn::PromoteTo(detail::double_tag, hn::UpperHalf(detail::half_tag, x.v)))
    {}
    [[nodiscard]] Floats rounded() const
    {
        return hn::Combine(float_tag, hn::DemoteTo(detail::half_tag, upper),
                           hn::DemoteTo(detail::half_tag, lower));
    }
    friend Doubles operator+(const Doubles& a, const Doubles& b)
    {
        return {hn::Add(a.lower, b.lower), hn::Add(a.upper, b.upper)};
    }
    friend Doubles operator-(const Doubles& a, const Doubles& b)
    {
        return {hn::Sub(a.lower, b.lower), hn::Sub(a.upper, b.upper)};
    }
    friend Doubles operator*(const Doubles& a, const Doubles& b)
    {
        return {hn::Mul(a.lower, b.lower), hn::Mul(a.upper, b.upper)};
    }
    friend Doubles operator/(const Doubles& a, const Doubles& b)
    {
        return {hn::Div(a.lower, b.lower), hn::Div(a.upper, b.upper)};
    }
    /// One bit per lane.
    [[nodiscard]] std::uint32_t negative() const
    {
        return bits([](Half x) { return hn::Lt(x, hn::Zero(detail::double_tag)); });
    }
    [[nodiscard]] std::uint32_t zero() const
    {
        return bits([](Half x) { return hn::Eq(x, hn::Zero(detail::double_tag)); });
    }

private:
    template <class Test>
    [[nodiscard]] std::uint32_t bits(const Test& test) const
    {
        std::array<std::uint8_t, 8> low{};
        std::array<std::uint8_t, 8> high{};
        hn::StoreMaskBits(detail::double_tag, test(lower), low.data());
        hn::StoreMaskBits(detail::double_tag, test(upper), high.data());
        return low[0] | static_cast<std::uint32_t>(high[0]) << floats_at_once / 2;
    }
};

/// Many rays, sheared as by ShearedRay.
class ShearedRays {
public:
    explicit ShearedRays(const RayOf<Floats>& rays) : origin_(rays.origin)
    {
        const Vec3Of<Floats> length = magnitude_of(rays.direction);
        // As in ShearedRay: kz is 0, 2 or 1.
        const Mask x_over_y = length.x > length.y;
        along_x_ = x_over_y && length.x > length.z;
        along_y_ = !x_over_y && length.y > length.z;
        const Vec3Of<Floats> d = permuted(rays.direction);
        shear_ = Vec3Of<Floats>(d.x, d.y, Floats(1.0f)) / d.z;
    }
    /// ShearedRay::shear, with z not yet scaled.
    [[nodiscard]] Vec3Of<Floats> shear(const Vec3& vertex) const
    {
        return sheared(Vec3Of<Floats>(vertex));
    }
    [[nodiscard]] Vec3Of<Floats> sheared(const Vec3Of<Floats>& vertex) const
    {
        const Vec3Of<Floats> moved = permuted(vertex - origin_);
        return {moved.x - shear_.x * moved.z, moved.y - shear_.y * moved.z, moved.z};
    }
    [[nodiscard]] const Floats& scale() const { return shear_.z; }
    /// For ShearedRay, ray by ray.
    [[nodiscard]] ShearOf<Floats> shears() const
    {
        return {select(along_x_, Words(0u), select(along_y_, Words(1u), Words(2u))), permuted(origin_),
                shear_};
    }

private:
    /// The coordinates kx, ky, kz.
    [[nodiscard]] Vec3Of<Floats> permuted(const Vec3Of<Floats>& v) const
    {
        return {select(along_x_, v.y, select(along_y_, v.z, v.x)),
                select(along_x_, v.z, select(along_y_, v.x, v.y)),
                select(along_x_, v.x, select(along_y_, v.y, v.z))};
    }

    Vec3Of<Floats> origin_;
    Mask along_x_, along_y_; // kz is 0; kz is 1
    Vec3Of<Floats> shear_;
};

/// A triangle, sheared for every ray. Names follow [Woop et al. 2013].
class ShearedTriangles {
public:
    /// `vertices`: the same for all rays, or one triangle for each.
    template <class V>
    ShearedTriangles(const ShearedRays& rays, const V (&vertices)[3])
        : a_(of(rays, vertices[0])), b_(of(rays, vertices[1])), c_(of(rays, vertices[2])),
          scale_(rays.scale()), u_(edge(c_, b_)), v_(edge(a_, c_)), w_(edge(b_, a_))
    {}

    /// Where the ray's line may pass through the triangle: everywhere that it does, and where an edge
    /// function is 0 as a float.
    [[nodiscard]] Mask may_hit() const { return of_one_sign(u_, v_, w_); }

    /// Where `candidates`: whether the ray hits at 0 < t < limit, and if so, its t.
    [[nodiscard]] Mask hit(Mask candidates, const Floats& limit, Floats& t) const
    {
        const Doubles U = edge_in_double(c_, b_);
        const Doubles V = edge_in_double(a_, c_);
        const Doubles W = edge_in_double(b_, a_);
        if (any(candidates && (u_ == 0.0f || v_ == 0.0f || w_ == 0.0f)))
            candidates = candidates && of_one_sign(select(u_ == 0.0f, U.rounded(), u_),
                                                   select(v_ == 0.0f, V.rounded(), v_),
                                                   select(w_ == 0.0f, W.rounded(), w_));
        const Doubles det = U + V + W;
        const Doubles T =
            U * Doubles(scale_ * a_.z) + V * Doubles(scale_ * b_.z) + W * Doubles(scale_ * c_.z);
        const Mask behind = mask_of_bits(det.zero() | (T.negative() ^ det.negative()));
        t = (T / det).rounded();
        return candidates && !behind && t > 0.0f && t < limit;
    }

    /// The weights of the second and the third vertex, of a hit.
    void weights(Floats& b1, Floats& b2) const
    {
        const Doubles U = edge_in_double(c_, b_);
        const Doubles V = edge_in_double(a_, c_);
        const Doubles W = edge_in_double(b_, a_);
        const Doubles det = U + V + W;
        b1 = (V / det).rounded();
        b2 = (W / det).rounded();
    }

private:
    static Vec3Of<Floats> of(const ShearedRays& rays, const Vec3& vertex) { return rays.shear(vertex); }
    static Vec3Of<Floats> of(const ShearedRays& rays, const Vec3Of<Floats>& vertex)
    {
        return rays.sheared(vertex);
    }
    static Floats edge(const Vec3Of<Floats>& p, const Vec3Of<Floats>& q)
    {
        return p.x * q.y - p.y * q.x;
    }
    static Doubles edge_in_double(const Vec3Of<Floats>& p, const Vec3Of<Floats>& q)
    {
        return Doubles(p.x) * Doubles(q.y) - Doubles(p.y) * Doubles(q.x);
    }
    static Mask of_one_sign(const Floats& u, const Floats& v, const Floats& w)
    {
        const Mask negative = u < 0.0f || v < 0.0f || w < 0.0f;
        const Mask positive = u > 0.0f || v > 0.0f || w > 0.0f;
        return !(negative && positive);
    }

    Vec3Of<Floats> a_, b_, c_;
    Floats scale_;
    Floats u_, v_, w_;
};

} // namespace fast
