#pragma once

// The parts of explain_sample.

#include "explain/sample.h"
#include "ref/transport/emission.h"
#include "ref/transport/visibility.h"

#include <span>

namespace explain {

/// The setting of one sample.
struct Setting {
    const ref::World& world;
    const ref::PathOptions& options;
    const ref::SampleId& id;
};

// ---- walks.cpp

/// The eye walk of at most `most` vertices, as ref::eye_subpath makes it. Appends its random numbers to
/// `draws`.
Walk eye_walk(const Setting& setting, std::size_t most, std::vector<Draw>& draws);

/// The same of the light walk.
Walk light_walk(const Setting& setting, std::size_t most, std::vector<Draw>& draws);

/// What the walk does at the surface `vertex`, which it reaches in direction -wo, with the numbers of
/// bounce `j`.
Bounce bounce_at(const Setting& setting, ref::Transport carried, const ref::Vertex& vertex,
                 const Vec3& wo, int j);

/// The first vertex after `from` by a density per solid angle, or the lobe's probability if `delta`.
Step step_to(const ref::Vertex& from, const ref::Vertex& vertex, double pdf, bool delta);

// ---- draws.cpp

Draw draw_of_camera(const ref::SampleId& id);
Draw draw_of_bounce(const Setting& setting, ref::Transport carried, const ref::Vertex& vertex, int j);
/// Of the emitter and its point: for a light walk, or for the next event at z_j.
Draw draw_of_emitter(const Setting& setting, ref::Event event, int j);
Draw draw_of_emission_direction(const Setting& setting, const ref::Vertex& y0);
/// Appends the draw if one of its numbers has an effect.
void append(std::vector<Draw>& draws, const Draw& draw);

// ---- obstacles.cpp: why the functions of ref/transport/connect.h and path_tracer.h return nothing.
// Each tests the conditions of its function in the same order, and throws std::logic_error if all hold.

void find_obstacle_of_emission_hit(const Setting& setting, Strategy& strategy);
/// Also sets the path of a next event whose light is lost, as far as it is known.
void find_obstacle_of_next_event(const Setting& setting, std::span<const ref::Vertex> z,
                                 Strategy& strategy);
void find_obstacle_of_light_image(const Setting& setting, std::span<const ref::Vertex> y,
                                  const ref::Vertex& eye, Strategy& strategy);
void find_obstacle_of_inner_connection(const Setting& setting, std::span<const ref::Vertex> y,
                                       std::span<const ref::Vertex> z, Strategy& strategy);

// ---- bidirectional.cpp, unidirectional.cpp

void explain_bidirectional(const Setting& setting, Sample& sample);
void explain_path(const Setting& setting, Sample& sample);

} // namespace explain
