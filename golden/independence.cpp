#include "golden/independence.h"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cmath>

namespace golden {

namespace {

constexpr double nearly_all = 0.9;        // share of the informative sites
constexpr double negligible = 1e-9;       // chance of a false result, all comparisons together
constexpr std::size_t most_before = 256;  // pictures before it that each is compared with
constexpr std::size_t third_pictures = 4; // that each pair is compared with
constexpr double times_closer = 3.0;      // than independent pictures are
constexpr double times_closer_than_golden = 1e4;

double sum_of(const images::Rgb& pixel)
{
    return pixel.r + pixel.g + pixel.b;
}

/// The pixels that are compared: every other one of every other row, as a reconstruction filter makes
/// neighbours depend on each other.
std::vector<std::size_t> sites_of(const images::Image& image)
{
    std::vector<std::size_t> sites;
    for (int y = 0; y < image.height; y += 2)
        for (int x = 0; x < image.width; x += 2)
            sites.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(x));
    return sites;
}

/// The number of informative sites, and in how many of them two pictures are so close that this is
/// evidence of the same noise.
struct Closeness {
    std::size_t sites = 0, close = 0;
    [[nodiscard]] bool is_nearly_everywhere() const
    {
        return static_cast<double>(close) >= nearly_all * static_cast<double>(sites);
    }
};

Closeness closeness_beside(const images::Image& a, const images::Image& b, const images::Image& third,
                           const std::vector<std::size_t>& sites)
{
    Closeness result;
    for (const std::size_t i : sites) {
        const double between = std::abs(sum_of(a.pixels[i]) - sum_of(b.pixels[i]));
        const double from_a = std::abs(sum_of(a.pixels[i]) - sum_of(third.pixels[i]));
        const double from_b = std::abs(sum_of(b.pixels[i]) - sum_of(third.pixels[i]));
        // A rounding error is the same in all pixels of one value, so it tells nothing of the noise.
        constexpr double rounding = 1e-5; // of sums of floats, relative
        if (std::max(between, from_a) <= rounding * std::abs(sum_of(third.pixels[i]))) continue;
        ++result.sites;
        result.close += times_closer * between < std::min(from_a, from_b);
        constexpr std::size_t first_look = 64; // most pairs end here
        if (result.sites == first_look && 2 * result.close < first_look) return result;
    }
    return result;
}

/// The same for two pictures, beside the golden, where they differ from it by more than its own noise. A
/// factor on all pixels, as of a wrong exposure, is divided out first.
Closeness closeness_beside_golden(const Golden& golden, const images::Image& a, const images::Image& b,
                                  const std::vector<std::size_t>& sites)
{
    std::vector<double> ratios;
    for (const std::size_t i : sites)
        if (const double mean = sum_of(golden.mean.pixels[i]); mean > 0.0)
            ratios.push_back(sum_of(a.pixels[i]) / mean);
    if (ratios.empty()) return {};
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    Closeness result;
    for (const std::size_t i : sites) {
        const double expected = *middle * sum_of(golden.mean.pixels[i]);
        const double error = *middle * sum_of(golden.standard_error.pixels[i]);
        const double from_golden = std::abs(sum_of(a.pixels[i]) - expected);
        if (!(from_golden > 5.0 * error)) continue;
        ++result.sites;
        result.close +=
            times_closer_than_golden * std::abs(sum_of(a.pixels[i]) - sum_of(b.pixels[i])) < from_golden;
    }
    return result;
}

/// In how many pixels the golden's noise is more than 1% of its mean, and whether two pictures are the
/// same there.
struct Sameness {
    std::size_t noisy = 0;
    bool equal = true;  // bit for bit, in all pixels
    bool within = true; // a thousandth of the noise of a batch, in those pixels
};

Sameness sameness_of(const Golden& golden, const images::Image& a, const images::Image& b)
{
    const double batches = static_cast<double>(golden.batches());
    Sameness result;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        result.equal = result.equal && a.pixels[i] == b.pixels[i];
        bool noisy = false;
        for (int c = 0; c < 3; ++c) {
            const double noise = golden.standard_error.pixels[i][c] * std::sqrt(batches);
            if (!(noise > 0.01 * std::abs(golden.mean.pixels[i][c]))) continue;
            noisy = true;
            result.within = result.within && std::abs(a.pixels[i][c] - b.pixels[i][c]) <= 1e-3 * noise;
        }
        result.noisy += noisy;
    }
    return result;
}

/// Whether all pictures are the same where the golden has noise.
std::optional<SharedNoise> all_the_same(const Golden& golden, std::span<const images::Image> pictures)
{
    bool equal = true;
    std::size_t noisy = 0;
    for (std::size_t i = 1; i < pictures.size(); ++i) {
        const Sameness same = sameness_of(golden, pictures[0], pictures[i]);
        // In few pixels, pictures of very many samples may agree so well by chance.
        constexpr std::size_t enough = 32;
        if (same.noisy == 0 || !(same.equal || (same.within && same.noisy >= enough)))
            return std::nullopt;
        equal = equal && same.equal;
        noisy = same.noisy;
    }
    return SharedNoise{0, 1,
                       equal ? "are equal in all pixels"
                             : "agree to a thousandth of the noise in all " + std::to_string(noisy) +
                                   " pixels that have noise"};
}

std::string say_close(const Closeness& found, const std::string& than)
{
    return "have the same noise: in " + std::to_string(found.close) + " of " +
           std::to_string(found.sites) + " pixels they are far closer to each other than to " + than;
}

} // namespace

double chance_of_shared_noise(std::size_t sites)
{
    if (sites == 0) return 1.0;
    const auto n = static_cast<double>(sites);
    const double first = std::ceil(nearly_all * n);
    return boost::math::cdf(boost::math::complement(boost::math::binomial(n, 1.0 / 3.0), first - 1.0));
}

std::optional<SharedNoise> shared_noise(const Golden& golden, std::span<const images::Image> pictures)
{
    const std::size_t count = pictures.size();
    if (count < 2) return std::nullopt;
    if (auto same = all_the_same(golden, pictures)) return same;
    const std::vector<std::size_t> sites = sites_of(golden.mean);
    if (count == 2) {
        const Closeness found = closeness_beside_golden(golden, pictures[0], pictures[1], sites);
        if (chance_of_shared_noise(found.sites) < negligible && found.is_nearly_everywhere())
            return SharedNoise{0, 1, say_close(found, "the golden")};
        return std::nullopt;
    }
    const double comparisons =
        static_cast<double>(count * std::min(count, most_before) * third_pictures);
    for (std::size_t j = 1; j < count; ++j)
        for (std::size_t i = j - std::min(j, most_before); i < j; ++i)
            for (std::size_t k = 1; k <= third_pictures; ++k) {
                const std::size_t third = (j + k * count / (third_pictures + 1) + 1) % count;
                if (third == i || third == j) continue;
                const Closeness found =
                    closeness_beside(pictures[i], pictures[j], pictures[third], sites);
                if (found.is_nearly_everywhere() &&
                    comparisons * chance_of_shared_noise(found.sites) < negligible)
                    return SharedNoise{i, j, say_close(found, "a third picture")};
            }
    return std::nullopt;
}

} // namespace golden
