// Mistakes that are known by noisy renders, on simulated pictures: a lamp in one corner, and light by
// two kinds of paths.

#include "golden/explain.h"

#include "golden/compare.h"
#include "tests/golden/simulated_golden.h"

#include <gtest/gtest.h>

#include <functional>

namespace {

using golden::Explanation;
using images::Image;
using images::Rgb;

class Explain : public golden_test::SimulatedGolden {
protected:
    static constexpr std::uint64_t batches = 256;
    static constexpr double samples = 4.0 * batches;
    using Share = double (*)(int x, int y);

    static double first(int x, int /*y*/) { return 0.2 + 0.02 * x; }
    static double second(int x, int y) { return 1.0 - first(x, y); }
    static double near_first(int x, int y) { return first(x, y) + 0.0001 * y; }

    /// `image` with each pixel times `factor` of its place.
    static Image times(Image image, const std::function<double(int, int)>& factor)
    {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) image.at(x, y) *= factor(x, y);
        return image;
    }
    /// A picture in which `share` of the light is missing.
    static Image lacking(Share share, std::uint64_t seed = 6)
    {
        return times(picture(batches, seed), [=](int x, int y) { return 1.0 - share(x, y); });
    }
    /// That a share of the light is missing, known by a render of `from` batches.
    static Explanation missing(const std::string& is, Share share, std::uint64_t from)
    {
        images::Film film(golden_test::size, golden_test::size);
        for (std::uint64_t batch = 0; batch < from; ++batch)
            film.add_batch(
                times(renderer().render(21, batch), [=](int x, int y) { return -share(x, y); }));
        return {is, film.mean(), film.standard_error(), static_cast<double>(from)};
    }
    /// The sentence, and the looks that it took. The first look has `from` batches, each further one
    /// twice as many, up to 256.
    static std::pair<std::string, int>
    explained(const std::vector<Image>& pictures,
              const std::vector<std::pair<std::string, Share>>& mistakes, std::uint64_t from)
    {
        int looks = 0;
        const auto more = [&] {
            std::vector<Explanation> all;
            if (from > 256) return all;
            for (const auto& [is, share] : mistakes) all.push_back(missing(is, share, from));
            ++looks;
            from *= 2;
            return all;
        };
        std::string sentence =
            golden::explain(reference(), pictures, samples, more, golden_test::for_small_pictures());
        return {std::move(sentence), looks};
    }
    inline static const std::vector<std::pair<std::string, Share>> both = {
        {"without the first", first}, {"without the second", second}};
};

TEST_F(Explain, NamesTheOneWithoutWhichNoDifferenceIsLeft)
{
    EXPECT_EQ(explained({lacking(first)}, both, 256).first,
              "Your picture is without the first: with this undone, it PASSes.");
    EXPECT_EQ(explained({lacking(second)}, both, 256).first,
              "Your picture is without the second: with this undone, it PASSes.");
    const Share other = [](int x, int y) { return 0.5 * first(x, y); };
    EXPECT_EQ(explained({lacking(other)}, both, 256).first, "");
}

TEST_F(Explain, SeveralPicturesAreJudgedByTheirScatterAndTheNoiseOfTheExplanation)
{
    std::vector<Image> pictures;
    for (std::uint64_t seed = 40; seed < 104; ++seed)
        pictures.push_back(times(picture(4, seed), [](int x, int y) { return 1.0 - first(x, y); }));
    EXPECT_EQ(explained(pictures, both, 128).first,
              "Your picture is without the first: with this undone, it PASSes.");
    // The render is off by chance, by three standard errors everywhere: that explains nothing, but is no
    // reason to reject the explanation.
    Explanation noisy = missing("without the first", first, 64);
    for (std::size_t i = 0; i < noisy.adds.pixels.size(); ++i) {
        noisy.error.pixels[i] = Rgb(0.05) * reference().mean.pixels[i];
        noisy.adds.pixels[i] += 0.002 * reference().mean.pixels[i];
    }
    const golden::CompareOptions options;
    const golden::Fitting fitting(reference(), pictures, samples, options);
    const double p = fitting.fit(noisy).p;
    noisy.error = Image(golden_test::size, golden_test::size);
    EXPECT_GT(p, 0.01);
    EXPECT_LT(fitting.fit(noisy).p, 0.1 * p);
}

TEST_F(Explain, FewSamplesAreEnoughForALargeMistake)
{
    // What is left is known to a few percent with 16 batches, and half of the light is missing.
    const auto [sentence, looks] = explained({lacking(first)}, both, 16);
    EXPECT_LT(looks, 5) << sentence;
    EXPECT_EQ(sentence.rfind("Your picture is without the first: with this undone, ", 0), 0u)
        << sentence;
}

TEST_F(Explain, NamesTogetherWhatCannotBeToldApart)
{
    EXPECT_EQ(explained({lacking(first)},
                        {{"without the first", first}, {"without nearly the first", near_first}}, 256)
                  .first,
              "Your picture is without the first, or without nearly the first: with either undone, it "
              "PASSes.");
    EXPECT_EQ(
        explained({lacking(first)}, {{"without the first", first}, {"the same", first}}, 256).first,
        "Your picture is without the first: with this undone, it PASSes. It would be the same if it "
        "were the same.");
    std::vector<std::pair<std::string, Share>> many;
    for (const char* is : {"a", "b", "c", "d"}) many.emplace_back(is, first);
    many[1].second = near_first;
    many[2].second = [](int x, int y) { return first(x, y) - 0.0001 * y; };
    many[3].second = [](int x, int y) { return first(x, y) + 0.0001 * x; };
    EXPECT_EQ(explained({lacking(first)}, many, 256).first, "");
}

TEST_F(Explain, AFittedExplanationIsNamedOnlyIfNoOtherFits)
{
    Explanation fitted = missing("fitted", near_first, 256);
    fitted.fitted = true;
    const auto sentence = [&](const Explanation& other) {
        bool more = true;
        return golden::explain(
            reference(), {lacking(first)}, samples,
            [&] {
                return std::exchange(more, false) ? std::vector{fitted, other}
                                                  : std::vector<Explanation>();
            },
            golden_test::for_small_pictures());
    };
    EXPECT_EQ(sentence(missing("without the first", first, 256)).rfind("Your picture is without", 0),
              0u);
    EXPECT_EQ(sentence(missing("without the second", second, 256)).rfind("Your picture is fitted", 0),
              0u);
}

} // namespace
