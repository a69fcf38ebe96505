#include "images/exr.h"
#include "images/image_error.h"
#include "tests/images/foreign_exr.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace {

using images::ExrPicture;
using images::Film;
using images::FilmState;
using images::Image;
using images::ImageError;
using images::Layers;
using images::Metadata;
using namespace images_test;
using namespace std::string_literals;

/// Keys and values of arbitrary bytes. A key contains no zero byte, because that ends it in the format.
Metadata any_metadata()
{
    const auto byte = rc::gen::resize(100, rc::gen::arbitrary<char>());
    const auto key = rc::gen::container<std::string>(rc::gen::nonZero<char>());
    const auto value = rc::gen::container<std::string>(byte);
    return *rc::gen::container<Metadata>(key, value);
}

/// A film of arbitrary moments and numbers of batches, for files; no render makes it.
Film any_film(const rc::Gen<double>& value, int columns, int rows)
{
    const auto number = rc::gen::resize(100, rc::gen::arbitrary<std::uint32_t>());
    const std::uint64_t first = *number;
    const images::BatchRange range{first, first + *number};
    std::vector<images::BatchMoments> blocks;
    for (std::size_t i = 0; i < largest_blocks(range).size(); ++i)
        blocks.push_back({any_image(value, columns, rows), any_image(value, columns, rows)});
    return {columns, rows, range, std::move(blocks)};
}

bool same_state(const std::vector<images::BatchMoments>& a, const std::vector<images::BatchMoments>& b)
{
    return std::ranges::equal(a, b, [](const auto& one, const auto& other) {
        return same_bits(one.mean, other.mean) && same_bits(one.squares, other.squares);
    });
}

RC_GTEST_PROP(Exr, EveryDoubleOfTheStateSurvivesARoundTrip, ())
{
    const TemporaryFolder folder;
    const Film film = any_film(any_double(), *rc::gen::inRange(1, 4), *rc::gen::inRange(1, 4));
    images::StrategySums sums(film.range().first);
    if (film.batches() > 0 && film.batches() < 3)
        for (std::uint64_t i = 0; i < film.batches(); ++i)
            sums.add({{{0, 2}, any_image(any_float(), film.width(), film.height())},
                      {{12, 3}, any_image(any_float(), film.width(), film.height())}});
    images::write_exr(folder / "a.exr", film, {}, {}, FilmState::keep, {}, sums);
    const ExrPicture read = images::read_exr(folder / "a.exr");
    RC_ASSERT(read.film.has_value());
    RC_ASSERT(read.film->range() == film.range());
    RC_ASSERT(same_state(read.film->blocks(), film.blocks()));
    RC_ASSERT(same_values(read.mean, rounded_to_float(film.mean())));
    RC_ASSERT(read.strategies.has_value() == (sums.range().size() > 0));
    if (read.strategies) RC_ASSERT(*read.strategies == sums);
}

TEST(Exr, AStateThatWasDamagedOrIsOfAnEarlierVersionIsNotUsed)
{
    const TemporaryFolder folder;
    images::write_exr(folder / "a.exr", film_of(Image(2, 2)), {{"scene", "cornell"}});
    std::string bytes = read_bytes(folder / "a.exr");
    EXPECT_TRUE(images::read_exr(folder / "a.exr").film);
    bytes[bytes.find("cornell")] = 'k';
    write_bytes(folder / "a.exr", bytes);
    const ExrPicture damaged = images::read_exr(folder / "a.exr");
    EXPECT_FALSE(damaged.film);
    EXPECT_TRUE(damaged.has_state);
    EXPECT_NE(damaged.no_state.find("checksum"), std::string::npos) << damaged.no_state;
    EXPECT_EQ(damaged.metadata.at("scene"), "kornell"); // the picture is read all the same
    EXPECT_THROW(images::expect_sound_state("a.exr", damaged), ImageError);
}

TEST(Exr, AStateOfAnEarlierVersionIsNamedAsSuch)
{
    // Before version 0.2 the state was one block, "state.mean" and "state.squares", without its range.
    const TemporaryFolder folder;
    images::write_exr(folder / "a.exr", film_of(Image(2, 2)), {}, {}, FilmState::omit);
    EXPECT_EQ(images::read_exr(folder / "a.exr").no_state, "holds no state to go on from");
    const ForeignChannels channels = {
        {"R", {1.0f}}, {"G", {1.0f}}, {"B", {1.0f}}, {"state.mean.R.hi", {0.0f}}};
    write_foreign(folder / "old.exr", Imf::Header(1, 1), channels, Imf::FLOAT);
    const ExrPicture old = images::read_exr(folder / "old.exr");
    EXPECT_TRUE(old.has_state);
    EXPECT_NE(old.no_state.find("earlier version"), std::string::npos) << old.no_state;
}

RC_GTEST_PROP(Exr, MeanErrorLayersAndMetadataSurviveARoundTrip, ())
{
    const TemporaryFolder folder;
    const Image mean = any_image(any_float());
    const Image squares = any_image(rc::gen::map(any_float(), [](float f) { return std::abs(f); }),
                                    mean.width, mean.height);
    const Film film(mean.width, mean.height, {0, 4}, {{mean, squares}});
    const Layers layers = {{"s2t3", any_image(any_float(), mean.width, mean.height)},
                           {"a.b c\xc3\xa9", any_image(any_float(), mean.width, mean.height)},
                           {"R", any_image(any_float(), mean.width, mean.height)}};
    const Metadata metadata = any_metadata();
    images::write_exr(folder / "a.exr", film, metadata, layers, FilmState::omit);

    const ExrPicture read = images::read_exr(folder / "a.exr");
    RC_ASSERT(same_values(read.mean, mean));
    RC_ASSERT(read.standard_error.has_value());
    RC_ASSERT(same_values(*read.standard_error, rounded_to_float(film.standard_error())));
    RC_ASSERT(read.layers.size() == layers.size());
    for (const auto& [name, layer] : layers) RC_ASSERT(same_values(read.layers.at(name), layer));
    RC_ASSERT(read.metadata == metadata);
    RC_ASSERT(!read.film.has_value());
}

TEST(Exr, MetadataMayHoldAnyText)
{
    const TemporaryFolder folder;
    const Metadata metadata = {{"", "empty key"},
                               {"empty value", ""},
                               {"command", "plumbline render 'a b.dae' --size 3x3\n"},
                               {"plumbline.plumbline.", "prefixed"},
                               {"channels", "named like an attribute of the format"},
                               {"zero", "a\0b"s},
                               {"greek \xce\xb1\xce\xb2", "\xff\xfe"},
                               {std::string(200, 'k'), std::string(100'000, 'v')}};
    images::write_exr(folder / "a.exr", film_of(Image(1, 1)), metadata);
    EXPECT_EQ(images::read_exr(folder / "a.exr").metadata, metadata);
}

TEST(Exr, TheSameFilmGivesTheSameBytes)
{
    const TemporaryFolder folder;
    images::write_exr(folder / "a.exr", film_of(Image(40, 30)), {{"seed", "1"}});
    images::write_exr(folder / "b.exr", film_of(Image(40, 30)), {{"seed", "1"}});
    EXPECT_EQ(read_bytes(folder / "a.exr"), read_bytes(folder / "b.exr"));
}

TEST(Exr, RenderingOnFromAFileGivesThePictureOfAnUninterruptedRender)
{
    const TemporaryFolder folder;
    const auto batch = [](int number) {
        Image image(2, 1);
        image.at(0, 0) = images::Rgb(1.0 / number, 1e-300 * number, 1e300 / number);
        image.at(1, 0) = images::Rgb(std::sqrt(number), 0.1 * number, 0.0);
        return image;
    };
    Film whole(2, 1);
    for (int i = 1; i <= 20; ++i) whole.add_batch(batch(i));

    Film part(2, 1);
    for (int i = 1; i <= 20; ++i) {
        part.add_batch(batch(i));
        images::write_exr(folder / "a.exr", part, {});
        part = images::read_exr(folder / "a.exr").film.value();
    }
    EXPECT_EQ(part, whole);
}

TEST(Exr, AFilmWithoutBatchesIsStoredWithItsInfiniteError)
{
    const TemporaryFolder folder;
    images::write_exr(folder / "a.exr", Film(3, 2), {});
    const ExrPicture read = images::read_exr(folder / "a.exr");
    EXPECT_EQ(read.film, Film(3, 2));
    EXPECT_EQ(read.standard_error->at(2, 1).g, std::numeric_limits<double>::infinity());
}

TEST(Exr, NamesThatTheFormatCannotHoldAreRefusedAndNothingIsWritten)
{
    const TemporaryFolder folder;
    const auto write = [&](const std::string& layer, const std::string& key, int columns = 2) {
        images::write_exr(folder / "a.exr", film_of(Image(2, 2)), {{key, ""}},
                          {{layer, Image(columns, 2)}});
    };
    for (const auto& name : {""s, "se"s, "state"s, "state.mean"s, "a\0b"s, std::string(201, 'x')})
        EXPECT_THROW(write(name, "key"), std::invalid_argument) << name;
    EXPECT_THROW(write("layer", "key", 3), std::invalid_argument);
    EXPECT_THROW(write("layer", "a\0b"s), ImageError);
    EXPECT_THROW(write("layer", std::string(201, 'x')), ImageError);
    EXPECT_EQ(folder.entries(), 0u);
    EXPECT_NO_THROW(write(std::string(200, 'x'), std::string(200, 'x')));
}

} // namespace
