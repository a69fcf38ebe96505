#include "extremes/axes/axes.h"
#include "extremes/wing.h"

namespace extremes {

std::vector<Axis> all_axes()
{
    std::vector<Axis> axes = {
        scale_axis(),        distance_axis(),     far_camera_axis(),     far_light_axis(),
        sliver_axis(),       area_axis(),         sphere_ratio_axis(),   sphere_floor_axis(),
        near_surface_axis(), grazing_axis(),      grazing_hit_axis(),    gap_axis(),
        ior_near_1_axis(),   ior_axis(),          critical_angle_axis(), fov_narrow_axis(),
        fov_wide_axis(),     radiance_axis(),     emitter_size_axis(),   albedo_axis(),
        tree_size_axis(),    coincident_axis(),   key_bits_axis(),       outlier_axis(),
        samples_axis(),      equal_samples_axis()};
    for (Axis& axis : axes) add_limits_of_device(axis);
    return axes;
}

} // namespace extremes
