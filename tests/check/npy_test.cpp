// NumPy's files, as NumPy writes them, and damaged ones.

#include "check/npy.h"

#include "images/image_error.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>

#include <array>

namespace {

using images_test::TemporaryFolder;
using images_test::write_bytes;

/// A file of version 1.0 with this header and these bytes.
std::string npy_file(const std::string& dictionary, const std::string& bytes)
{
    std::string header = dictionary;
    header.resize(117, ' ');
    return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + "\n" + bytes;
}

check::NpyArray read(const std::string& bytes)
{
    const TemporaryFolder folder;
    write_bytes(folder / "a.npy", bytes);
    return check::read_npy(folder / "a.npy");
}

std::string error_of(const std::string& bytes)
{
    try {
        read(bytes);
    } catch (const images::ImageError& error) {
        const std::string text = error.what();
        return text.substr(text.find("a.npy"));
    }
    return "no error";
}

TEST(Npy, ReadsBackWhatItWrites)
{
    const std::array shape{std::size_t{2}, std::size_t{3}};
    const std::array<double, 6> reals = {0.5, -1, 1e30, 0, 0.1F, 3};
    const std::string floats = check::npy_bytes(shape, reals, true);
    EXPECT_EQ(floats.size(), 128U + 24U); // users rely on the offset
    EXPECT_EQ(read(floats).type, "float32");
    EXPECT_EQ(read(floats).reals[4], static_cast<double>(0.1F));
    EXPECT_EQ(read(check::npy_bytes(shape, reals, false)).reals,
              std::vector<double>(reals.begin(), reals.end()));
    const std::array<std::int64_t, 6> integers = {0, -1, 1 << 20, 7, 8, 9};
    EXPECT_EQ(read(check::npy_bytes(shape, integers)).integers,
              std::vector<std::int64_t>(integers.begin(), integers.end()));
    EXPECT_EQ(read(check::npy_bytes(std::array{std::size_t{0}, std::size_t{6}}, {}, true)).shape,
              (std::vector<std::size_t>{0, 6}));
}

TEST(Npy, ReadsOtherTypesByteOrdersAndFortranOrder)
{
    EXPECT_EQ(read(npy_file("{'descr': '>i2', 'fortran_order': False, 'shape': (2,), }",
                            std::string("\x01\x02\xff\xff", 4)))
                  .integers,
              (std::vector<std::int64_t>{258, -1}));
    EXPECT_EQ(read(npy_file("{'descr': '<u4', 'fortran_order': False, 'shape': (2,), }",
                            std::string("\xff\xff\xff\xff\x05\x00\x00\x00", 8)))
                  .integers,
              (std::vector<std::int64_t>{-1, 5}));
    // Stored as 0 2 4, 1 3 5: the columns one after another.
    const std::string columns("\x00\x02\x04\x01\x03\x05", 6);
    EXPECT_EQ(
        read(npy_file("{'descr': '|u1', 'fortran_order': True, 'shape': (3, 2), }", columns)).integers,
        (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
    std::string second = npy_file("{'descr': '|i1', 'fortran_order': False, 'shape': (1,), }", "\x07");
    second[6] = 2; // version 2.0 has four bytes for the length
    second.insert(10, std::string(2, '\0'));
    EXPECT_EQ(read(second).integers, std::vector<std::int64_t>{7});
}

TEST(Npy, NamesTheFileAndTheDamage)
{
    const std::string good =
        npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (1,), }", "1234");
    EXPECT_EQ(read(good).reals.size(), 1U);
    EXPECT_EQ(error_of(""), "a.npy: is not a .npy file of NumPy");
    EXPECT_EQ(error_of("PK\x03\x04 and so on"), "a.npy: is not a .npy file of NumPy");
    EXPECT_EQ(error_of(good.substr(0, 60)), "a.npy: ends in its header");
    EXPECT_EQ(error_of(good.substr(0, 130)),
              "a.npy: holds 2 bytes of elements: the shape (1,) of float32 needs 4");
    EXPECT_EQ(error_of(good + "5"),
              "a.npy: holds 5 bytes of elements: the shape (1,) of float32 needs 4");
    std::string ninth = good;
    ninth[6] = 9;
    EXPECT_EQ(error_of(ninth), "a.npy: has version 9 of .npy, which is unknown");
    EXPECT_EQ(error_of(npy_file("{'descr': '<f2', 'fortran_order': False, 'shape': (1,), }", "12")),
              "a.npy: holds elements of type '<f2': there must be integers, float32 or float64");
    EXPECT_EQ(
        error_of(npy_file("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,), }", "1234")),
        "a.npy: is a structured array: write an array of plain numbers");
    for (const char* header :
         {"", "{'descr': '<f4'", "{'descr': '<f4', 'fortran_order': False, 'shape': (1, x), }",
          "{'descr': '<f4', 'fortran_order': Maybe, 'shape': (1,), }",
          "{'descr': '<f4', 'fortran_order': False, 'shape': (-1,), }"})
        EXPECT_EQ(error_of(npy_file(header, "1234")), "a.npy: has a header that is not NumPy's")
            << header;
    EXPECT_EQ(
        error_of(npy_file(
            "{'descr': '<f4', 'fortran_order': False, 'shape': (4294967296, 4294967296), }", "")),
        "a.npy: holds 0 bytes of elements: the shape (4294967296, 4294967296) of float32 needs more");
}

} // namespace
