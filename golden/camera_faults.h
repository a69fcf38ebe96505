#pragma once

// Mistakes of the camera that take further renders of the golden's scene to undo.

#include "golden/faults.h"
#include "images/image.h"

#include <string>
#include <vector>

namespace golden {

/// The mistake of a picture of `wrong` instead of `right`, two renders of the golden's scene: to undo it
/// adds their difference. Where `wrong` is NaN it is not known, and the golden's pixel stands there.
/// Light may become negative by the noise of the renders; it is then spread over the least block of
/// 2^n x 2^n pixels whose mean is not, since no picture has negative light.
Fault rendered_fault(std::string is, images::Image wrong, images::Image right);

/// The same for a picture of `wrong` with fine detail in other places: each pixel is the golden's, times
/// the ratio of the picture and `wrong`, or plus the picture where `wrong` is black. Where the golden is
/// black the result is black, which the sum above is not by noise; but it is brighter by the square of
/// the relative noise of `wrong`.
Fault ratio_fault(std::string is, images::Image wrong);

/// The picture was taken half a pixel aside, in one or both directions: samples are at the corners of
/// pixels, for example. `fine`: the golden's scene with twice the pixels in both directions. First with
/// rendered_fault, then with ratio_fault.
std::vector<Fault> half_pixel_faults(const images::Image& fine);

} // namespace golden
