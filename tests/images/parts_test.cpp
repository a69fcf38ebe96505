// Which files are parts of one render, and which batches they lack.

#include "images/image_error.h"
#include "images/parts.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace {

using images::BatchRange;
using images::Metadata;
using images::Part;

const Metadata of_render = {{"scene_hash", "1"}, {"seed", "2"}, {"samples", "16"}};

Part part(const BatchRange& range, const Metadata& metadata = of_render, int columns = 8)
{
    return {describe(range) + ".exr", {columns, 6, metadata, range, ""}, range};
}

std::string fault(std::vector<Part> parts, std::optional<std::uint64_t> batches = std::nullopt)
{
    return images_test::error_of<images::ImageError>([&] { in_order(std::move(parts), batches); });
}

RC_GTEST_PROP(Parts, InAnyOrderMakeTheWhole, ())
{
    std::vector<Part> parts;
    std::uint64_t end = 0;
    for (int i = *rc::gen::inRange(1, 9); i-- > 0;) {
        const auto next = end + *rc::gen::inRange<std::uint64_t>(1, 100);
        parts.push_back(part({end, next}));
        end = next;
    }
    std::vector<Part> shuffled = parts;
    for (std::size_t i = shuffled.size(); i-- > 1;)
        std::swap(shuffled[i], shuffled[*rc::gen::inRange<std::size_t>(0, i + 1)]);
    const std::vector<Part> ordered = in_order(std::move(shuffled), end);
    for (std::size_t i = 0; i < parts.size(); ++i) RC_ASSERT(ordered[i].range == parts[i].range);
}

TEST(Parts, TheBatchesThatAreMissingOrDoubledAreNamed)
{
    EXPECT_EQ(fault({part({0, 4}), part({6, 8})}), "6..8.exr: batches 4..6 are missing before it");
    EXPECT_EQ(fault({part({0, 4}), part({5, 8})}), "5..8.exr: batch 4 is missing before it");
    EXPECT_EQ(fault({part({6, 8}), part({0, 4}), part({3, 6})}),
              "3..6.exr: batch 3 is also in 0..4.exr");
    EXPECT_EQ(fault({part({0, 9}), part({2, 3})}), "2..3.exr: batch 2 is also in 0..9.exr");
    // Of the whole, all are needed, and no other.
    EXPECT_EQ(fault({part({0, 4}), part({4, 8})}, 8), "");
    EXPECT_EQ(fault({part({4, 8})}, 8), "4..8.exr: batches 0..4 are missing before it");
    EXPECT_EQ(fault({part({0, 4})}, 8), "0..4.exr: batches 4..8 are missing after it");
    EXPECT_EQ(fault({part({0, 4})}, 2),
              "0..4.exr: batches 2..4 are beyond the end of the whole, batch 1");
    // Parts of a part need not begin with batch 0.
    EXPECT_EQ(fault({part({6, 8}), part({4, 6})}), "");
    EXPECT_THROW(images::in_order({}), std::invalid_argument);
}

TEST(Parts, OfAnotherRenderAreRefused)
{
    Metadata other = of_render;
    other["seed"] = "3";
    EXPECT_EQ(fault({part({0, 4}), part({4, 8}, other)}),
              "4..8.exr: is no part of the same render as 0..4.exr: its seed is '3', not '2'");
    other = of_render;
    other["device"] = "host";
    EXPECT_EQ(fault({part({0, 4}), part({4, 8}, other)}),
              "4..8.exr: is no part of the same render as 0..4.exr: its device is 'host', not said in "
              "the other");
    EXPECT_EQ(fault({part({0, 4}, other), part({4, 8})}),
              "4..8.exr: is no part of the same render as 0..4.exr: it does not say its device, 'host' "
              "in the other");
    EXPECT_EQ(fault({part({0, 4}), part({4, 8}, of_render, 9)}),
              "4..8.exr: is no part of the same render as 0..4.exr: its size is '9x6', not '8x6'");
    // What depends on the batches may differ.
    other = of_render;
    other["samples"] = "99";
    other["dropped"] = "3";
    other["interrupted"] = "before 5 samples";
    EXPECT_EQ(fault({part({0, 4}), part({4, 8}, other)}), "");
}

TEST(Parts, AreReadWithoutTheirPictures)
{
    const images_test::TemporaryFolder folder;
    images::Film film(3, 2, 5);
    film.add_batch(images::Image(3, 2));
    film.add_batch(images::Image(3, 2));
    images::write_exr(folder / "a.exr", film, of_render);
    const Part read = images::read_part(folder / "a.exr");
    EXPECT_EQ(read.range, (BatchRange{5, 7}));
    EXPECT_EQ(read.says.metadata, of_render);
    EXPECT_EQ(read.says.width, 3);
    EXPECT_EQ(read.says.height, 2);

    images::write_exr(folder / "none.exr", images::Film(3, 2), of_render);
    EXPECT_THROW(images::read_part(folder / "none.exr"), images::ImageError);
    images::write_exr(folder / "finished.exr", film, of_render, {}, images::FilmState::omit);
    EXPECT_THROW(images::read_part(folder / "finished.exr"), images::ImageError);
}

TEST(Parts, ADamagedByteIsFoundByTheChecksum)
{
    const images_test::TemporaryFolder folder;
    images::Film film(3, 2);
    film.add_batch(images::Image(3, 2));
    images::write_exr(folder / "a.exr", film, of_render);
    const std::string sound = images_test::read_bytes(folder / "a.exr");
    for (std::size_t i = 0; i < sound.size(); i += 3) {
        std::string bytes = sound;
        bytes[i] = static_cast<char>(bytes[i] ^ 4);
        images_test::write_bytes(folder / "a.exr", bytes);
        // The name of the attribute itself, if it is hit, leaves a file without a state or a checksum;
        // the picture's own bytes are the same then.
        const std::string fault = images_test::error_of<images::ImageError>(
            [&] { (void)images::read_part(folder / "a.exr"); });
        const bool in_the_names =
            sound.substr(i > 24 ? i - 24 : 0, 60).find("plumblineChecksum") != std::string::npos;
        EXPECT_TRUE(!fault.empty() || in_the_names) << i;
    }
}

} // namespace
