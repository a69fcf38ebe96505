#pragma once

// One function per axis; each has a file of its own, named after it.

#include "extremes/axis.h"

namespace extremes {

Axis scale_axis();
Axis distance_axis();
Axis far_camera_axis();
Axis far_light_axis();
Axis sliver_axis();
Axis area_axis();
Axis sphere_ratio_axis();
Axis sphere_floor_axis();
Axis near_surface_axis();
Axis grazing_axis();
Axis grazing_hit_axis();
Axis gap_axis();
Axis ior_near_1_axis();
Axis ior_axis();
Axis critical_angle_axis();
Axis fov_narrow_axis();
Axis fov_wide_axis();
Axis tree_size_axis();
Axis coincident_axis();
Axis key_bits_axis();
Axis outlier_axis();
Axis radiance_axis();
Axis emitter_size_axis();
Axis albedo_axis();
Axis samples_axis();
Axis equal_samples_axis();

} // namespace extremes
