#include "images/exr.h"
#include "images/image_error.h"
#include "images/pfm.h"
#include "images/png.h"
#include "images/write_image.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>

namespace {

using images::ImageError;
using namespace images_test;

images::Film some_film()
{
    images::Image mean(3, 2);
    mean.at(1, 1) = images::Rgb(0.25, 0.5, 2.0);
    return film_of(mean);
}

TEST(WriteImage, TheEndingOfTheNameChoosesTheFormat)
{
    const TemporaryFolder folder;
    const images::Film film = some_film();
    images::write_image(folder / "a.exr", film, {{"seed", "7"}});
    images::write_image(folder / "a.pfm", film, {});
    images::write_image(folder / "a.png", film, {}, 1.0);
    const images::ExrPicture exr = images::read_exr(folder / "a.exr");
    EXPECT_EQ(exr.mean, film.mean());
    EXPECT_EQ(exr.metadata, (images::Metadata{{"seed", "7"}}));
    EXPECT_EQ(exr.film, film);
    EXPECT_EQ(images::read_pfm(folder / "a.pfm"), film.mean());
    images::write_png(folder / "expected.png", film.mean(), 1.0);
    EXPECT_EQ(read_bytes(folder / "a.png"), read_bytes(folder / "expected.png"));
}

TEST(WriteImage, OtherEndingsAreRefusedByName)
{
    const TemporaryFolder folder;
    for (const char* name : {"a.jpg", "a", "exr", ".exr", "a.exr.gz"}) {
        const std::string expected =
            (folder / name).string() + ": the name of a picture must end in .exr, .pfm or .png";
        EXPECT_EQ(error_of<ImageError>([&] { images::write_image(folder / name, some_film(), {}); }),
                  expected);
        EXPECT_EQ(error_of<ImageError>([&] { images::check_writable(folder / name); }), expected);
    }
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(WriteImage, CheckingBeforehandFindsAMissingFolderAndLeavesNothingBehind)
{
    const TemporaryFolder folder;
    EXPECT_NO_THROW(images::check_writable(folder / "a.exr"));
    EXPECT_THROW(images::check_writable(folder / "missing/a.exr"), ImageError);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(WriteImage, APictureWithoutPixelsIsAnErrorInFormatsThatHoldNone)
{
    const TemporaryFolder folder;
    for (const char* name : {"a.exr", "a.pfm", "a.png"})
        EXPECT_THROW(images::write_image(folder / name, images::Film(), {}), ImageError) << name;
    EXPECT_EQ(folder.entries(), 0u);
}

} // namespace
