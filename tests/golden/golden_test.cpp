#include "golden/golden.h"
#include "images/image_error.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <stdexcept>

namespace {

using golden::Golden;
using golden::GoldenMaker;
using images::FilmState;
using images::Image;
using images::ImageError;
using images::Rgb;
using namespace images_test;

const images::Metadata metadata = {{"batch_size", "4"}, {"scene", "test"}};

/// Non-negative values. Some are 0, the others need all bits of a double.
Image any_batch(int width, int height)
{
    return any_image(rc::gen::map(rc::gen::inRange(0, 1000), [](int i) { return i / 7.0; }), width,
                     height);
}

void expect_equal(const Golden& a, const Golden& b)
{
    EXPECT_TRUE(same_bits(a.mean, b.mean));
    EXPECT_TRUE(same_bits(a.standard_error, b.standard_error));
    EXPECT_EQ(a.metadata, b.metadata);
    EXPECT_TRUE(same_bits(a.functionals.pilot().mean, b.functionals.pilot().mean));
    EXPECT_TRUE(same_bits(a.functionals.pilot().noise, b.functionals.pilot().noise));
    EXPECT_EQ(a.functionals.pilot().batches, b.functionals.pilot().batches);
    EXPECT_EQ(a.reference, b.reference);
    EXPECT_EQ(a.slopes, b.slopes);
}

RC_GTEST_PROP(Golden, IsReadAsItWasMade, ())
{
    const TemporaryFolder folder;
    const int width = *rc::gen::inRange(1, 20);
    const int height = *rc::gen::inRange(1, 20);
    GoldenMaker maker(width, height, 3);
    const int batches = *rc::gen::inRange(4, 12);
    for (int i = 0; i < batches; ++i) maker.add_batch(any_batch(width, height));
    maker.write(folder / "a.exr", metadata, FilmState::omit);
    const Golden golden = golden::read_golden(folder / "a.exr");
    expect_equal(golden, maker.golden(metadata));
    RC_ASSERT(golden.reference.size() == static_cast<std::size_t>(batches - 3));
    RC_ASSERT(!::testing::Test::HasFailure());
}

RC_GTEST_PROP(Golden, GoingOnFromAFileGivesTheBytesOfAnUninterruptedMaking, ())
{
    const TemporaryFolder folder;
    std::vector<Image> batches;
    for (int i = 0; i < 9; ++i) batches.push_back(any_batch(5, 4));
    const auto interruption = static_cast<std::size_t>(*rc::gen::inRange(0, 9));

    GoldenMaker whole(5, 4, 4);
    for (const Image& batch : batches) whole.add_batch(batch);
    whole.write(folder / "whole.exr", metadata, FilmState::omit);

    GoldenMaker first(5, 4, 4);
    for (std::size_t i = 0; i < interruption; ++i) first.add_batch(batches[i]);
    first.write(folder / "part.exr", metadata, FilmState::keep);
    GoldenMaker second = GoldenMaker::resume(folder / "part.exr");
    RC_ASSERT(second.film().batches() == interruption);
    for (std::size_t i = interruption; i < batches.size(); ++i) second.add_batch(batches[i]);
    second.write(folder / "resumed.exr", metadata, FilmState::omit);
    RC_ASSERT(read_bytes(folder / "resumed.exr") == read_bytes(folder / "whole.exr"));
}

RC_GTEST_PROP(Golden, HasTheSameBytesFromPartsOfAnyRanges, ())
{
    constexpr std::size_t pilot = 5;
    constexpr std::size_t all = 14;
    const TemporaryFolder folder;
    std::vector<Image> batches;
    for (std::size_t i = 0; i < all; ++i) batches.push_back(any_batch(5, 4));
    GoldenMaker whole(5, 4, pilot);
    for (const Image& batch : batches) whole.add_batch(batch);
    whole.write(folder / "whole.exr", metadata, FilmState::omit);

    const auto fill = [&](GoldenMaker maker, std::size_t end) {
        for (std::size_t i = maker.film().range().end; i < end; ++i) maker.add_batch(batches[i]);
        maker.write(folder / "part.exr", metadata, FilmState::keep);
        return GoldenMaker::resume(folder / "part.exr");
    };
    const std::size_t cut = *rc::gen::inRange<std::size_t>(1, pilot);
    GoldenMaker made = fill({5, 4, pilot}, cut);
    made.append(fill({5, 4, pilot, cut}, pilot));
    RC_ASSERT(made.functionals().has_value());
    const golden::Functionals functionals = *made.functionals();
    const std::size_t second = *rc::gen::inRange(pilot + 1, all - 1);
    const std::size_t third = *rc::gen::inRange(second + 1, all);
    GoldenMaker late = fill({functionals, second}, third);
    if (*rc::gen::arbitrary<bool>()) { // the later parts are joined first
        late.append(fill({functionals, third}, all));
        made.append(fill({functionals, pilot}, second));
        made.append(late);
    } else {
        made.append(fill({functionals, pilot}, second));
        made.append(late);
        made.append(fill({functionals, third}, all));
    }
    made.write(folder / "made.exr", metadata, FilmState::omit);
    RC_ASSERT(read_bytes(folder / "made.exr") == read_bytes(folder / "whole.exr"));
}

TEST(Golden, PartsThatDoNotFitAreRefused)
{
    const auto filled = [](GoldenMaker maker, std::uint64_t end, double value) {
        for (std::uint64_t i = maker.film().range().end; i < end; ++i) {
            Image batch(2, 1);
            batch.pixels.assign(2, Rgb(value + static_cast<double>(i)));
            maker.add_batch(batch);
        }
        return maker;
    };
    const GoldenMaker pilot = filled({2, 1, 4}, 4, 1.0);
    const GoldenMaker other = filled({2, 1, 4}, 4, 2.0);
    EXPECT_THROW(GoldenMaker(2, 1, 4, 4), std::invalid_argument);
    EXPECT_THROW(GoldenMaker(*pilot.functionals(), 3), std::invalid_argument);
    // The functionals of batches after a pilot that lacks its beginning are not known.
    EXPECT_THROW(filled({2, 1, 4, 2}, 5, 1.0), std::invalid_argument);
    const GoldenMaker later = filled({*pilot.functionals(), 4}, 6, 1.0);
    GoldenMaker end_of_pilot = filled({2, 1, 4, 2}, 4, 1.0);
    EXPECT_THROW(end_of_pilot.append(later), std::invalid_argument);
    GoldenMaker of_other = other;
    EXPECT_EQ(error_of<std::invalid_argument>([&] { of_other.append(later); }),
              "the parts are made with different pilots");
    GoldenMaker of_five = filled({2, 1, 5}, 4, 1.0);
    EXPECT_THROW(of_five.append(later), std::invalid_argument);

    const TemporaryFolder folder;
    EXPECT_THROW((void)later.golden(metadata), std::invalid_argument);
    EXPECT_THROW(later.write(folder / "a.exr", metadata, FilmState::omit), std::invalid_argument);
    later.write(folder / "a.exr", metadata, FilmState::keep);
    EXPECT_EQ(error_of<ImageError>([&] { golden::read_golden(folder / "a.exr"); }),
              (folder / "a.exr").string() + ": a part of a golden: plumbline merge joins parts");
}

TEST(Golden, MeanIsThatOfAllBatchesAndTheReferenceThoseAfterThePilot)
{
    GoldenMaker maker(2, 1, 2);
    for (const double value : {1.0, 3.0, 5.0, 7.0}) {
        Image batch(2, 1);
        batch.pixels.assign(2, Rgb(value));
        maker.add_batch(batch);
    }
    const Golden golden = maker.golden(metadata);
    EXPECT_EQ(golden.mean.pixels[0], Rgb(4.0));
    EXPECT_EQ(golden.functionals.pilot().mean.pixels[0], Rgb(2.0));
    ASSERT_EQ(golden.reference.size(), 2u);
    // The pilot's mean is 2. The reference batches are 2.5 and 3.5 times that mean, so the second is
    // farther from it.
    EXPECT_GT(golden.reference[0][0], 0.0F);
    EXPECT_GT(golden.reference[1][0], golden.reference[0][0]);
}

TEST(Golden, DoesNotExistBeforeThePilotIsComplete)
{
    const TemporaryFolder folder;
    EXPECT_THROW(GoldenMaker(2, 2, 1), std::invalid_argument);
    GoldenMaker maker(2, 2, 2);
    maker.add_batch(Image(2, 2));
    maker.add_batch(Image(2, 2));
    EXPECT_THROW((void)maker.golden(metadata), std::invalid_argument);
    EXPECT_THROW(maker.write(folder / "a.exr", metadata, FilmState::omit), std::invalid_argument);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(Golden, ABatchThatDoesNotFitIsRefusedAndLeavesNoTrace)
{
    GoldenMaker maker(2, 2, 2);
    maker.add_batch(Image(2, 2));
    EXPECT_THROW(maker.add_batch(Image(2, 3)), std::invalid_argument);
    Image batch(2, 2);
    batch.at(1, 0).b = std::numeric_limits<double>::infinity();
    EXPECT_EQ(error_of<std::invalid_argument>([&] { maker.add_batch(batch); }),
              "batch 1: pixel (1, 0) is NaN or infinite");
    EXPECT_EQ(maker.film().batches(), 1u);
}

/// The error message of read_golden for a golden on which `edit` was called, without the file's name.
/// Empty if there is no error.
template <class Edit>
std::string error_after(const Edit& edit)
{
    const TemporaryFolder folder;
    GoldenMaker maker(4, 4, 2);
    for (int i = 0; i < 4; ++i) maker.add_batch(Image(4, 4));
    maker.write(folder / "a.exr", metadata, FilmState::omit);
    images::ExrPicture picture = images::read_exr(folder / "a.exr");
    edit(picture);
    images::write_exr(folder / "b.exr", film_of(picture.mean), picture.metadata, picture.layers);
    const std::string error = error_of<ImageError>([&] { golden::read_golden(folder / "b.exr"); });
    return error.empty() ? error : error.substr((folder / "b.exr").string().size());
}

std::string error_with(const std::string& key, const std::string& value)
{
    return error_after([&](images::ExrPicture& picture) {
        if (value == "removed")
            picture.metadata.erase(key);
        else
            picture.metadata[key] = value;
    });
}

TEST(Golden, FilesThatAreNoGoldensAreRefusedWithTheReason)
{
    const TemporaryFolder folder;
    images::write_exr(folder / "a.exr", film_of(Image(3, 3)), metadata);
    EXPECT_EQ(error_of<ImageError>([&] { golden::read_golden(folder / "a.exr"); }),
              (folder / "a.exr").string() + ": not a golden: has no pilot");
    EXPECT_EQ(error_of<ImageError>([&] { GoldenMaker::resume(folder / "a.exr"); }),
              (folder / "a.exr").string() + ": not a golden: says nothing of its golden.pilot_batches");

    GoldenMaker maker(3, 3, 2);
    maker.add_batch(Image(3, 3));
    maker.add_batch(Image(3, 3));
    maker.write(folder / "b.exr", metadata, FilmState::keep);
    EXPECT_EQ(error_of<ImageError>([&] { golden::read_golden(folder / "b.exr"); }),
              (folder / "b.exr").string() + ": not a finished golden: no batch after its pilot");
    maker.add_batch(Image(3, 3));
    maker.write(folder / "c.exr", metadata, FilmState::omit);
    EXPECT_EQ(error_of<ImageError>([&] { GoldenMaker::resume(folder / "c.exr"); }),
              (folder / "c.exr").string() + ": holds no state to go on from");
}

TEST(Golden, DamagedMetadataIsAnErrorAndNoCrash)
{
    EXPECT_EQ(error_with("scene", "another"), ""); // other metadata may be edited
    EXPECT_EQ(error_with("golden.pilot_batches", "removed"),
              ": not a golden: says nothing of its golden.pilot_batches");
    EXPECT_EQ(error_with("golden.pilot_batches", "-1"), ": '-1' is no golden.pilot_batches");
    EXPECT_EQ(error_with("golden.pilot_batches", "0"), ": damaged golden: pilot: no batches");
    EXPECT_EQ(error_with("golden.reference_batches", "2x"), ": '2x' is no golden.reference_batches");
    EXPECT_EQ(error_with("golden.reference_batches", "4000000000"),
              ": damaged golden: says it holds 4000000000 reference batches, and does not");
    EXPECT_EQ(error_with("golden.reference_batches", "99999999999"),
              ": '99999999999' is no golden.reference_batches");
    EXPECT_NE(error_with("golden.functionals", "version 0").find("make it again"), std::string::npos);
}

TEST(Golden, AReferenceValueThatIsNotFiniteIsAnError) // no comparison with it would ever be true
{
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})
        EXPECT_EQ(error_after([&](images::ExrPicture& picture) {
                      picture.layers.at("reference.001").at(2, 1).b = value;
                  }),
                  ": damaged golden: a reference value is NaN or infinite");
}

} // namespace
