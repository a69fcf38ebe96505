#pragma once

// Bidirectional path tracing in stages [van Antwerpen 2011; Davidovic et al. 2014]: first the light
// walks of all samples, whose vertices are stored, then their eye walks. Number types, queues and the
// order of contributions are as in path_stages.h.
//
//   generate_light   y_0 of each sample, its light image, and the first ray
//   shade_light      stores y_n; a candidate for its light image; the bounce
//   test_splat       adds the light images whose ray is not occluded, to any pixel
//   generate_eye     the ray of each sample through its pixel
//   shade_eye        emission where the walk has come to; a next event candidate; the bounce
//   connect          candidates of the connections of z_n to the stored y_{s-1}, for one s
//
// Extend and test_shadow are those of stage_job.h. Light tracing is the first half.

#include "cuda/stages/eye_stages.h"
#include "cuda/stages/light_stages.h"
