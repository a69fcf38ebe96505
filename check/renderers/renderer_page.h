#pragma once

// The results of a check as a page.

#include "check/renderers/check_renderer.h"

#include <string>

namespace check {

/// A self-contained HTML page without scripts: the verdicts as a table, what failures have in common,
/// and for each scene its reason and pictures: golden, the mean of the candidates, and the difference in
/// standard errors. It loads no other files.
std::string renderer_page(const RendererCheck& check, const RendererOptions& options);

/// The difference of the mean of `pictures` from the golden in standard errors, as colours: red where
/// they are brighter, blue where they are darker, white where they agree; full colour from 6 standard
/// errors on. The standard errors are those of the mean and of the golden together. With one picture,
/// whose noise is not known, those of the golden's estimator.
images::Image difference_picture(const golden::Golden& golden,
                                 const std::vector<images::Image>& pictures);

} // namespace check
