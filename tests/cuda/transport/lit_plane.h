#pragma once

// Lights above the plane z = 0, and the mean of a picture of the plane, in closed form.
//
// The mean of a picture is the integral of the irradiance over the film, by Gauss-Legendre quadrature
// with 6 x 6 points per quarter, which is accurate to 1e-9 for functions as smooth as these. The light
// of a narrow spot falls only on a part of the picture; it is integrated over the directions of the
// spot instead.

#include "tests/cuda/transport/odd_builder.h"

#include <algorithm>
#include <functional>

namespace fast_transport_test {

/// The film reaches from -span to span on both axes at the distance 1 from the eye.
struct PlaneEye {
    scenes::Vec3 from, right, up, along;
    double span;
};

/// Irradiance at a point of the plane z = 0, in coordinates of the frame.
using Irradiance = std::function<scenes::Rgb(const scenes::Vec3&)>;

/// Half the full angle of the narrowest spot light: the fast path rejects any below 1.53e-5.
inline constexpr double narrowest_spot = 2e-5;

/// Collects lights and their closed forms.
class LitPlane {
public:
    LitPlane(OddBuilder& builder, const PlaneEye& eye) : builder_(builder), eye_(eye)
    {
        watch(-eye.along.z);
    }

    void add_point();
    void add_spot();
    void add_narrow_spot();
    void add_sun();
    void add_sky();
    void add_lamp();

    [[nodiscard]] const scenes::Rgb& irradiance() const { return irradiance_; } // its mean over the film
    [[nodiscard]] bool has_narrow_spot() const { return narrow_; }
    [[nodiscard]] bool far_or_low() const { return far_or_low_; } // any light that is not near and high
    /// How much larger than a unit roundoff the relative errors of lengths (in units of the frame) and
    /// of angles become in the irradiance: 1 / length and 1 / cosine.
    [[nodiscard]] double condition() const { return condition_; }
    /// The relative error that single precision may cause in the power of a narrow spot light.
    [[nodiscard]] double spot_tolerance() const { return spot_tolerance_; }

private:
    void light(const Irradiance& irradiance);
    void watch(double length_or_cosine) { condition_ = std::max(condition_, 1 / length_or_cosine); }
    scenes::Vec3 any_place();

    OddBuilder& builder_;
    PlaneEye eye_;
    scenes::Rgb irradiance_{0};
    bool narrow_ = false, far_or_low_ = false;
    double condition_ = 10;
    double spot_tolerance_ = 0;
    scenes::Rgb under_sky_{0}; // mean irradiance over the film that a lamp hides, per radiance
};

} // namespace fast_transport_test
