#pragma once

// The same as film_add.h for many samples at once.

#include "cuda/parallel/floats_records.h"
#include "cuda/stages/film_add.h"

namespace fast {

inline void film_add(const FilmTarget& film, const Launch& launch, const Mask& mask, const Words& slot,
                     int s, int t, const Vec3Of<Floats>& value, const Floats& weight)
{
    if (none(mask)) return;
    const Vec3Of<Floats> sum = weight * value;
    const Mask finite = is_finite(value) && is_finite_number(weight);
    if (!film.layers.empty() || any(mask && !finite)) {
        one_by_one(mask, [&](int lane) {
            film_add(film, launch, true, lane_of(slot, lane), s, t, lane_of(value, lane),
                     lane_of(weight, lane));
        });
        return;
    }
    alignas(64) std::array<float, floats_at_once> x;
    alignas(64) std::array<float, floats_at_once> y;
    alignas(64) std::array<float, floats_at_once> z;
    alignas(64) std::array<std::uint32_t, floats_at_once> slots;
    hn::Store(sum.x.v, float_tag, x.data());
    hn::Store(sum.y.v, float_tag, y.data());
    hn::Store(sum.z.v, float_tag, z.data());
    hn::Store(slot.v, word_tag, slots.data());
    one_by_one(mask, [&](int i) {
        const auto lane = static_cast<std::size_t>(i);
        film.own[slots[lane]] += Rgb(x[lane], y[lane], z[lane]);
    });
}

inline void film_splat(const FilmTarget& film, const Mask& mask, const Words& pixel, int s,
                       const Vec3Of<Floats>& value, const Floats& weight)
{
    one_by_one(mask, [&](int lane) {
        film_splat(film, true, lane_of(pixel, lane), s, lane_of(value, lane), lane_of(weight, lane));
    });
}

} // namespace fast
