#pragma once

// NumPy's files of one array, `.npy` [numpy.lib.format, versions 1.0 to 3.0].

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace check {

/// An array in C order (the last index is the fastest).
struct NpyArray {
    std::vector<std::size_t> shape;
    std::string type;                   // as NumPy names it: "float32", "uint64"
    std::vector<double> reals;          // of float32 and float64, exactly; empty for integers
    std::vector<std::int64_t> integers; // empty for reals. The largest uint32 or uint64 becomes -1
    [[nodiscard]] bool is_integer() const { return type.front() != 'f'; }
};

/// "(12, 4)", "(12,)": a shape as NumPy writes it.
std::string shape_text(std::span<const std::size_t> shape);

/// The array in the file: integers of 8 to 64 bits, float32 or float64, of either byte order, in C or in
/// Fortran order. Throws images::ImageError that names the file: not such a file, another type, too few
/// or too many bytes.
NpyArray read_npy(const std::filesystem::path& path);

/// The bytes of a `.npy` file (version 1.0) with these numbers in C order. The header is 128 bytes long,
/// so the numbers begin at byte 128. Reals become float32 if `single_precision`. The sizes must agree.
std::string npy_bytes(std::span<const std::size_t> shape, std::span<const double> reals,
                      bool single_precision);
/// The same for int32.
std::string npy_bytes(std::span<const std::size_t> shape, std::span<const std::int64_t> integers);

} // namespace check
