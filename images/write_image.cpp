#include "images/write_image.h"
#include "images/atomic_file.h"
#include "images/exr.h"
#include "images/file_ending.h"
#include "images/image_error.h"
#include "images/pfm.h"
#include "images/png.h"

namespace images {

namespace {

enum class Format { exr, pfm, png };

Format format_of(const std::filesystem::path& path)
{
    if (has_ending(path, ".exr")) return Format::exr;
    if (has_ending(path, ".pfm")) return Format::pfm;
    if (has_ending(path, ".png")) return Format::png;
    throw ImageError(path, "the name of a picture must end in .exr, .pfm or .png");
}

} // namespace

void write_image(const std::filesystem::path& path, const Film& film, const Metadata& metadata,
                 double exposure)
{
    switch (format_of(path)) {
    case Format::exr:
        return write_exr(path, film, metadata);
    case Format::pfm:
        return write_pfm(path, film.mean());
    case Format::png:
        return write_png(path, film.mean(), exposure);
    }
}

void check_writable(const std::filesystem::path& path)
{
    format_of(path);
    check_place(path);
}

} // namespace images
