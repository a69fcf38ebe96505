#include "check/mistakes/fit_roulette.h"

#include <algorithm>
#include <limits>
#include <map>

namespace check {

namespace {

using images::Image;
using images::Rgb;

/// The sums of all pixels of each block, row by row.
std::vector<Rgb> blocks_of(const Image& image)
{
    const int side = (std::max(image.width, image.height) + 7) / 8;
    const int columns = (image.width + side - 1) / side;
    const int rows = (image.height + side - 1) / side;
    std::vector<Rgb> sums(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), Rgb(0.0));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sums[static_cast<std::size_t>(y / side * columns + x / side)] += image.at(x, y);
    return sums;
}

/// The sum of squares of what is left of `difference`, relative to `golden`, if the mistake is undone.
double left_over(const Mistake& mistake, const std::map<std::size_t, std::vector<Rgb>>& parts,
                 std::vector<Rgb> difference, const std::vector<Rgb>& golden)
{
    for (const auto& [part, times] : mistake.adds)
        for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= times * parts.at(part)[i];
    double sum = 0.0;
    for (std::size_t i = 0; i < difference.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (golden[i][c] > 0.0)
                sum += (difference[i][c] / golden[i][c]) * (difference[i][c] / golden[i][c]);
    return sum;
}

} // namespace

Mistake best_roulette(const std::vector<RouletteMistake>& roulettes, const PartPictures& parts,
                      const Image& picture, const Image& golden)
{
    std::map<std::size_t, std::vector<Rgb>> sums;
    for (const RouletteMistake& roulette : roulettes)
        for (const auto& [part, times] : roulette.with(0.5).adds)
            if (!sums.contains(part)) sums.emplace(part, blocks_of(parts.of(part).mean()));
    const std::vector<Rgb> expected = blocks_of(golden);
    std::vector<Rgb> difference = blocks_of(picture);
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= expected[i];

    Mistake best;
    double least = std::numeric_limits<double>::infinity();
    const auto attempt = [&](const RouletteMistake& roulette, int thousandths) {
        Mistake mistake = roulette.with(thousandths / 1000.0);
        const double left = left_over(mistake, sums, difference, expected);
        if (!(left < least) && !best.is.empty()) return false;
        least = left;
        best = std::move(mistake);
        return true;
    };
    const RouletteMistake* of = nullptr;
    int near = 0;
    for (const RouletteMistake& roulette : roulettes)
        for (int thousandths = 50; thousandths <= 990; thousandths += 10)
            if (attempt(roulette, thousandths)) {
                of = &roulette;
                near = thousandths;
            }
    for (int thousandths = near - 9; thousandths <= std::min(990, near + 9); ++thousandths)
        attempt(*of, thousandths);
    return best;
}

} // namespace check
