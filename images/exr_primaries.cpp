#include "images/exr_primaries.h"

#include "images/image_error.h"

#include <ImfChromaticities.h>
#include <ImfStandardAttributes.h>

#include <cmath>
#include <stdexcept>

namespace images {

std::optional<glm::dmat3> to_rec709(const std::filesystem::path& path, const Imf::Header& header)
{
    if (!Imf::hasChromaticities(header)) return std::nullopt;
    const Imf::Chromaticities stated = Imf::chromaticities(header);
    const Imf::Chromaticities rec709;
    if (stated == rec709) return std::nullopt;
    const auto none = [&] {
        return ImageError(path, "its chromaticities are no primaries and white of colours");
    };
    Imath::M44f matrix; // for row vectors
    try {
        matrix = Imf::RGBtoXYZ(stated, 1.0f) * Imf::XYZtoRGB(rec709, 1.0f);
    } catch (const std::invalid_argument&) { // three primaries on a line, or a white without luminance
        throw none();
    }
    glm::dmat3 result;
    for (int from = 0; from < 3; ++from)
        for (int to = 0; to < 3; ++to) {
            const float value = matrix[from][to];
            if (!std::isfinite(value)) throw none();
            result[from][to] = static_cast<double>(value);
        }
    return result;
}

} // namespace images
