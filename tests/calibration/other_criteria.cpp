#include "tests/calibration/other_criteria.h"

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>

namespace calibration {

namespace {

using images::Image;
using images::Rgb;

double root_mean_square(const Image& picture, const Image& reference, const Image&)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const Rgb d = picture.pixels[i] - reference.pixels[i];
        sum += d.r * d.r + d.g * d.g + d.b * d.b;
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(picture.pixels.size())));
}

double displayed(const Rgb& color)
{
    const double luminance = 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
    return std::pow(std::clamp(luminance, 0.0, 1.0), 1.0 / 2.2);
}

double one_minus_ssim(const Image& picture, const Image& reference, const Image&)
{
    constexpr int side = 8;
    constexpr double c1 = 0.01 * 0.01; // the constants of the paper, for values of 0 to 1
    constexpr double c2 = 0.03 * 0.03;
    double sum = 0.0;
    int windows = 0;
    for (int y0 = 0; y0 + side <= picture.height; y0 += side)
        for (int x0 = 0; x0 + side <= picture.width; x0 += side) {
            double a = 0.0;
            double b = 0.0;
            double aa = 0.0;
            double bb = 0.0;
            double ab = 0.0;
            for (int y = y0; y < y0 + side; ++y)
                for (int x = x0; x < x0 + side; ++x) {
                    const double u = displayed(picture.at(x, y));
                    const double v = displayed(reference.at(x, y));
                    a += u;
                    b += v;
                    aa += u * u;
                    bb += v * v;
                    ab += u * v;
                }
            constexpr double n = side * side;
            a /= n;
            b /= n;
            const double variances = aa / n - a * a + bb / n - b * b;
            const double covariance = ab / n - a * b;
            sum +=
                (2.0 * a * b + c1) * (2.0 * covariance + c2) / ((a * a + b * b + c1) * (variances + c2));
            ++windows;
        }
    return 1.0 - sum / windows;
}

template <class Use>
void for_each_z(const Image& picture, const Image& reference, const Image& error, const Use& use)
{
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (error.pixels[i][c] > 0.0)
                use(std::abs(picture.pixels[i][c] - reference.pixels[i][c]) / error.pixels[i][c]);
}

double share_beyond_sidak(const Image& picture, const Image& reference, const Image& error)
{
    double values = 0.0;
    for_each_z(picture, reference, error, [&](double) { values += 1.0; });
    const double level = 1.0 - std::pow(1.0 - 0.01, 1.0 / values);
    const double limit =
        boost::math::quantile(boost::math::complement(boost::math::normal(), level / 2.0));
    double beyond = 0.0;
    for_each_z(picture, reference, error, [&](double z) { beyond += z > limit ? 1.0 : 0.0; });
    return beyond / values;
}

double largest_z(const Image& picture, const Image& reference, const Image& error)
{
    double largest = 0.0;
    for_each_z(picture, reference, error, [&](double z) { largest = std::max(largest, z); });
    return largest;
}

} // namespace

const std::vector<Criterion>& other_criteria()
{
    static const std::vector<Criterion> criteria = {
        {"RMSE", root_mean_square},
        {"1 - SSIM", one_minus_ssim},
        {"share of pixels with a large z", share_beyond_sidak},
        {"largest z of a pixel", largest_z}};
    return criteria;
}

} // namespace calibration
