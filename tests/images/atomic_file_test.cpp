#include "images/atomic_file.h"
#include "images/image_error.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string>
#include <thread>

namespace {

using images::ImageError;
using images::write_atomically;
using namespace images_test;
namespace fs = std::filesystem;

std::string error_of_writing(const fs::path& path, const std::string& bytes = "new")
{
    return error_of<ImageError>([&] { write_atomically(path, bytes); });
}

TEST(AtomicFile, WritesWhatItIsGivenAndNothingElse)
{
    const TemporaryFolder folder;
    const std::string bytes("\0\n\xff whole", 9);
    write_atomically(folder / "a", bytes);
    EXPECT_EQ(images::read_file(folder / "a"), bytes);
    write_atomically(folder / "a", "");
    EXPECT_EQ(images::read_file(folder / "a"), "");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, AReaderSeesTheOldFileOrTheNewOneButNoneInBetween)
{
    const TemporaryFolder folder;
    const std::string old_bytes(1 << 20, 'o');
    const std::string new_bytes(1 << 19, 'n');
    write_atomically(folder / "a", old_bytes);
    std::atomic<bool> done = false;
    std::jthread writer([&] {
        for (int i = 0; i < 20; ++i) {
            write_atomically(folder / "a", new_bytes);
            write_atomically(folder / "a", old_bytes);
        }
        done = true;
    });
    int mixtures = 0;
    while (!done) {
        const std::string seen = images::read_file(folder / "a");
        if (seen != old_bytes && seen != new_bytes) ++mixtures;
    }
    EXPECT_EQ(mixtures, 0);
}

TEST(AtomicFile, ADiskThatIsFullLeavesTheOldFileAndNoTemporary)
{
    const TemporaryFolder folder;
    write_atomically(folder / "a", "old");
    // The kernel cuts the write short at the limit, as on a full disk.
    const auto previous_action = std::signal(SIGXFSZ, SIG_IGN);
    rlimit previous{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &previous), 0);
    const rlimit small{4096, previous.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string error = error_of_writing(folder / "a", std::string(10'000, 'x'));
    setrlimit(RLIMIT_FSIZE, &previous);
    std::signal(SIGXFSZ, previous_action);

    EXPECT_EQ(error, (folder / "a").string() + ": cannot write: File too large");
    EXPECT_EQ(read_bytes(folder / "a"), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, AFolderWithoutPermissionIsAnErrorForWritingAndChecking)
{
    const TemporaryFolder folder;
    fs::create_directory(folder / "closed");
    fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
    // Permissions do not apply to root: as root, the attempt is made as the user nobody.
    constexpr uid_t nobody = 65534;
    const uid_t self = geteuid();
    ASSERT_EQ(seteuid(self == 0 ? nobody : self), 0);
    const std::string error = error_of_writing(folder / "closed/a");
    const std::string check = error_of<ImageError>([&] { images::check_place(folder / "closed/a"); });
    ASSERT_EQ(seteuid(self), 0);
    EXPECT_NE(error.find("closed/a: cannot create a file in its folder: Permission denied"),
              std::string::npos)
        << error;
    EXPECT_EQ(check, error);
    EXPECT_TRUE(fs::is_empty(folder / "closed"));
}

TEST(AtomicFile, APlaceThatIsNoFileIsAnError)
{
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    write_bytes(folder / "file", "");
    const auto expect = [](const fs::path& path, const std::string& problem) {
        const std::string expected = path.string() + ": " + problem;
        EXPECT_EQ(error_of_writing(path), expected);
        EXPECT_EQ(error_of<ImageError>([&] { images::check_place(path); }), expected);
    };
    expect(folder / "sub", "is a folder, not a file");
    expect(folder / "sub/", "names no file");
    expect("", "names no file");
    expect("/dev/null", "is no regular file");
    expect(folder / "missing/a", "cannot create a file in its folder: No such file or directory");
    expect(folder / "file/a", "cannot create a file in its folder: Not a directory");
    EXPECT_EQ(folder.entries(), 2u);
}

TEST(AtomicFile, ANameAsLongAsTheSystemAllowsIsNoProblem)
{
    const TemporaryFolder folder;
    const std::string longest(255, 'x');
    write_atomically(folder / longest, "new");
    EXPECT_EQ(read_bytes(folder / longest), "new");
    EXPECT_NE(error_of_writing(folder / (longest + "x")).find("File name too long"), std::string::npos);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, PermissionsAndSymbolicLinksOutliveAWrite)
{
    const TemporaryFolder folder;
    write_bytes(folder / "a", "old");
    fs::permissions(folder / "a",
                    fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    fs::create_symlink("a", folder / "link");
    write_atomically(folder / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_bytes(folder / "a"), "new");
    EXPECT_EQ(fs::status(folder / "a").permissions(),
              fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST(AtomicFile, CheckingLeavesTheFolderAndTheFileAlone)
{
    const TemporaryFolder folder;
    images::check_place(folder / "a");
    EXPECT_EQ(folder.entries(), 0u);
    write_bytes(folder / "a", "old");
    images::check_place(folder / "a");
    EXPECT_EQ(read_bytes(folder / "a"), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, ReadingWhatIsNoFileIsAnError)
{
    const TemporaryFolder folder;
    const auto error = [](const fs::path& path) {
        return error_of<ImageError>([&] { images::read_file(path); });
    };
    EXPECT_EQ(error(folder / "a"), (folder / "a").string() + ": No such file or directory");
    EXPECT_EQ(error(folder.path()), folder.path().string() + ": is no regular file");
    EXPECT_EQ(error("/dev/zero"), "/dev/zero: is no regular file");
}

TEST(ImageErrorText, IsOneLineWhateverTheFileIsCalled)
{
    EXPECT_STREQ(ImageError("a\nb", "broken\r\nbadly").what(), "a b: broken  badly");
}

} // namespace
