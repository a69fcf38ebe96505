#include "golden/exr.h"
#include "golden/image_error.h"
#include "golden/pfm.h"
#include "golden/png.h"
#include "golden/write_image.h"
#include "tests/golden/generators.h"
#include "tests/golden/temporary_folder.h"

#include <gtest/gtest.h>

namespace {

using golden::ImageError;
using namespace golden_test;

golden::Film some_film()
{
    golden::Image mean(3, 2);
    mean.at(1, 1) = golden::Rgb(0.25, 0.5, 2.0);
    return film_of(mean);
}

TEST(WriteImage, TheEndingOfTheNameChoosesTheFormat)
{
    const TemporaryFolder folder;
    const golden::Film film = some_film();
    golden::write_image(folder / "a.exr", film, {{"seed", "7"}});
    golden::write_image(folder / "a.pfm", film, {});
    golden::write_image(folder / "a.png", film, {}, 1.0);
    const golden::ExrPicture exr = golden::read_exr(folder / "a.exr");
    EXPECT_EQ(exr.mean, film.mean());
    EXPECT_EQ(exr.metadata, (golden::Metadata{{"seed", "7"}}));
    EXPECT_EQ(exr.film, film);
    EXPECT_EQ(golden::read_pfm(folder / "a.pfm"), film.mean());
    golden::write_png(folder / "expected.png", film.mean(), 1.0);
    EXPECT_EQ(read_bytes(folder / "a.png"), read_bytes(folder / "expected.png"));
}

TEST(WriteImage, OtherEndingsAreRefusedByName)
{
    const TemporaryFolder folder;
    for (const char* name : {"a.jpg", "a", "exr", ".exr", "a.exr.gz"}) {
        const std::string expected =
            (folder / name).string() + ": the name of a picture must end in .exr, .pfm or .png";
        EXPECT_EQ(error_of<ImageError>([&] { golden::write_image(folder / name, some_film(), {}); }),
                  expected);
        EXPECT_EQ(error_of<ImageError>([&] { golden::check_writable(folder / name); }), expected);
    }
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(WriteImage, CheckingBeforehandFindsAMissingFolderAndLeavesNothingBehind)
{
    const TemporaryFolder folder;
    EXPECT_NO_THROW(golden::check_writable(folder / "a.exr"));
    EXPECT_THROW(golden::check_writable(folder / "missing/a.exr"), ImageError);
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(WriteImage, APictureWithoutPixelsIsAnErrorInFormatsThatHoldNone)
{
    const TemporaryFolder folder;
    for (const char* name : {"a.exr", "a.pfm", "a.png"})
        EXPECT_THROW(golden::write_image(folder / name, golden::Film(), {}), ImageError) << name;
    EXPECT_EQ(folder.entries(), 0u);
}

} // namespace
