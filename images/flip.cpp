// Names follow the papers: Yy, Cx, Cz for the opponent colours that are filtered as the eye does, delta
// E for differences, the subscripts c and f for colours and features, p and q for the constants.
//
// [Andersson et al. 2020] FLIP: A Difference Evaluator for Alternating Images. HPG 2020.
// [Andersson et al. 2021] Visualizing Errors in Rendered High Dynamic Range Images. Eurographics 2021.

#include "images/flip.h"
#include "images/flip_colours.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace images {

using namespace flip_colours;

namespace {

using std::numbers::pi;

// ------------------------------------------------------------------ filters
/// One weight per offset -r..r along an axis.
using Kernel = std::vector<double>;

template <class F>
Kernel kernel(int radius, F&& weight)
{
    Kernel k;
    for (int i = -radius; i <= radius; ++i) k.push_back(weight(static_cast<double>(i)));
    return k;
}

/// The plane filtered along rows by `x` and along columns by `y`; beyond the border it has the values of
/// the border.
std::vector<double> filter(const std::vector<double>& plane, int width, int height, const Kernel& x,
                           const Kernel& y)
{
    const auto pass = [&](const std::vector<double>& in, const Kernel& k, int dx, int dy) {
        const int radius = static_cast<int>(k.size()) / 2;
        std::vector<double> out(in.size());
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column) {
                double sum = 0.0;
                for (int i = -radius; i <= radius; ++i) {
                    const int c = std::clamp(column + i * dx, 0, width - 1);
                    const int r = std::clamp(row + i * dy, 0, height - 1);
                    sum += k[static_cast<std::size_t>(i + radius)] *
                           in[static_cast<std::size_t>(r * width + c)];
                }
                out[static_cast<std::size_t>(row * width + column)] = sum;
            }
        return out;
    };
    return pass(pass(plane, x, 1, 0), y, 0, 1);
}

std::vector<double> plane_of(const Image& image, int channel)
{
    std::vector<double> plane;
    for (const Rgb& pixel : image.pixels) plane.push_back(pixel[channel]);
    return plane;
}

double sum_of(const Kernel& k)
{
    double sum = 0.0;
    for (const double w : k) sum += w;
    return sum;
}

/// The contrast sensitivity of the eye per opponent colour, as a sum of two Gaussians whose parameters
/// the paper gives: a weight and a width b in degrees squared [Andersson et al. 2020, table 1].
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity sensitivity[3] = {
    {1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

/// The picture filtered by the contrast sensitivity of the eye, as CIELAB with the Hunt effect.
Image seen(const Image& opponent, double pixels_per_degree)
{
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * pixels_per_degree));
    Image result(opponent.width, opponent.height);
    for (int channel = 0; channel < 3; ++channel) {
        const auto [a1, b1, a2, b2] = sensitivity[channel];
        const auto gaussian = [&](double b) {
            return kernel(radius, [&](double i) {
                return std::exp(-pi * pi * i * i / (b * pixels_per_degree * pixels_per_degree));
            });
        };
        const Kernel g1 = gaussian(b1);
        const Kernel g2 = gaussian(b2);
        const double w1 = a1 * std::sqrt(pi / b1);
        const double w2 = a2 * std::sqrt(pi / b2);
        const double norm = w1 * sum_of(g1) * sum_of(g1) + w2 * sum_of(g2) * sum_of(g2);
        const std::vector<double> plane = plane_of(opponent, channel);
        const std::vector<double> f1 = filter(plane, opponent.width, opponent.height, g1, g1);
        const std::vector<double> f2 =
            w2 > 0.0 ? filter(plane, opponent.width, opponent.height, g2, g2) : f1;
        for (std::size_t i = 0; i < plane.size(); ++i)
            result.pixels[i][channel] = (w1 * f1[i] + w2 * f2[i]) / norm;
    }
    for (Rgb& pixel : result.pixels) pixel = hunt_lab_of(glm::clamp(rgb_of_opponent(pixel), 0.0, 1.0));
    return result;
}

/// The strength of edges and points at each pixel: first and second derivatives of a Gaussian as wide as
/// the eye's feature detectors, positive and negative weights each summing to one
/// [Andersson et al. 2020, sec. 4.2].
struct Features {
    std::vector<double> edge, point;
};

Features features_of(const Image& opponent, double pixels_per_degree)
{
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const Kernel smooth =
        kernel(radius, [&](double i) { return std::exp(-i * i / (2 * sigma * sigma)); });
    const auto derivative = [&](auto&& factor) {
        Kernel k =
            kernel(radius, [&](double i) { return factor(i) * std::exp(-i * i / (2 * sigma * sigma)); });
        double positive = 0.0;
        double negative = 0.0;
        for (const double w : k) (w > 0.0 ? positive : negative) += std::abs(w);
        for (double& w : k) w /= (w > 0.0 ? positive : negative) * sum_of(smooth);
        return k;
    };
    const Kernel first = derivative([](double i) { return -i; });
    const Kernel second = derivative([&](double i) { return i * i / (sigma * sigma) - 1.0; });

    std::vector<double> achromatic = plane_of(opponent, 0);
    for (double& y : achromatic) y = (y + 16.0) / 116.0;
    const auto magnitude = [&](const Kernel& k) {
        std::vector<double> x = filter(achromatic, opponent.width, opponent.height, k, smooth);
        const std::vector<double> y = filter(achromatic, opponent.width, opponent.height, smooth, k);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
        return x;
    };
    return {magnitude(first), magnitude(second)};
}

// ------------------------------------------------------------------ the metric
/// The difference of two seen colours as an error in [0, 1] [Andersson et al. 2020, sec. 4.1.3].
double colour_error(const Rgb& a, const Rgb& b)
{
    constexpr double q_c = 0.7;
    constexpr double p_c = 0.4;
    constexpr double p_t = 0.95;
    static const double largest =
        std::pow(hyab(hunt_lab_of({0.0, 1.0, 0.0}), hunt_lab_of({0.0, 0.0, 1.0})), q_c);
    const double d = std::pow(hyab(a, b), q_c);
    return d < p_c * largest ? d * p_t / (p_c * largest)
                             : p_t + (d - p_c * largest) / (largest - p_c * largest) * (1.0 - p_t);
}

} // namespace

void expect_comparable(const Image& reference, const Image& test)
{
    if (reference.width != test.width || reference.height != test.height)
        throw std::invalid_argument("FLIP compares pictures of one size");
    if (first_non_finite(reference) || first_non_finite(test))
        throw std::invalid_argument("FLIP compares pictures of finite values");
}

ErrorMap flip_of_displayed(const Image& reference, const Image& test, double pixels_per_degree)
{
    expect_comparable(reference, test);
    const auto opponent = [](Image image) {
        for (Rgb& pixel : image.pixels) pixel = opponent_of(pixel);
        return image;
    };
    const Image a = opponent(reference);
    const Image b = opponent(test);
    const Image seen_a = seen(a, pixels_per_degree);
    const Image seen_b = seen(b, pixels_per_degree);
    const Features features_a = features_of(a, pixels_per_degree);
    const Features features_b = features_of(b, pixels_per_degree);
    ErrorMap map(a.pixels.size());
    for (std::size_t i = 0; i < map.size(); ++i) {
        const double e_c = colour_error(seen_a.pixels[i], seen_b.pixels[i]);
        const double e_f = std::sqrt(std::max(std::abs(features_a.edge[i] - features_b.edge[i]),
                                              std::abs(features_a.point[i] - features_b.point[i])) /
                                     std::numbers::sqrt2); // q_f = 1/2
        map[i] = std::pow(e_c, 1.0 - e_f);                 // [Andersson et al. 2020, sec. 4.3]
    }
    return map;
}

} // namespace images
