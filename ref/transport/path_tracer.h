#pragma once

// Unidirectional path tracing [Kajiya 1986], and its steps: one edge of the eye walk after the other.

#include "ref/transport/bsdf.h"
#include "ref/transport/world.h"

#include <optional>

namespace ref {

/// Unidirectional path tracing [Kajiya 1986]: one walk from the eye. Each of its vertices is joined to
/// a fresh point of an emitter (s = 1, next event), and the walk itself may hit an emitter (s = 0,
/// emission hit). The two are weighted by the balance heuristic [Veach 1997, sec. 9.2]. A family that
/// the options leave out is not computed. An Integrator.
void trace_path(const World& world, const PathOptions& options, const SampleId& id,
                std::vector<Contribution>& out);

/// The eye walk on its edge j, from z_{j-1} to z_j.
struct EyeWalk {
    Ray ray;
    Vec3 from;      // the vertex that `ray` leaves, without offset
    Rgb throughput; // product of f |cos| / pdf over the bounces so far
    double pdf;     // of the ray's direction, per solid angle, with roulette included
    bool delta;     // the bounce was a delta: next-event estimation cannot sample its direction
};

/// A surface that the eye walk meets: z_j, with the direction `wo_local` to z_{j-1}.
struct WalkVertex {
    SurfacePoint point;
    const scenes::Material& material;
    Frame frame;
    Vec3 wo_local;

    WalkVertex(const World& world, const EyeWalk& walk, const SurfacePoint& hit);
};

/// Edge 1, from the eye.
EyeWalk first_edge(const World& world, const SampleId& id);

/// The last edge that can contribute: the last vertex of a path of max_edges edges can only be an
/// emission hit.
int last_edge(const PathOptions& options);

/// s = 0 where edge j leaves the scene: the light of the environment, if there is one.
std::optional<Contribution> environment_of_edge(const World& world, const SampleId& id, int j,
                                                const EyeWalk& walk);

/// s = 0: the light that `point`, where edge j ends, emits back along the edge.
std::optional<Contribution> emission_of_edge(const World& world, const SampleId& id, int j,
                                             const EyeWalk& walk, const SurfacePoint& point);

/// The density (sr^-1) with which next-event estimation at z_{j-1} would sample the edge j that ends at
/// `point`; null: that leaves the scene.
double pdf_of_next_event(const World& world, const EyeWalk& walk, const SurfacePoint* point);

/// s = 1: joins z_j to a point of an emitter.
std::optional<Contribution> next_event_of_vertex(const World& world, const PathOptions& options,
                                                 const SampleId& id, int j, const EyeWalk& walk,
                                                 const WalkVertex& vertex);

/// The density (sr^-1) with which the walk would go on from z_j in direction `wi_local`.
double pdf_of_bounce(const PathOptions& options, int j, const WalkVertex& vertex, const Vec3& wi_local);

/// Edge j + 1: the walk bounces at z_j. None if the surface or Russian roulette ends the walk.
std::optional<EyeWalk> next_edge(const PathOptions& options, const SampleId& id, int j,
                                 const EyeWalk& walk, const WalkVertex& vertex);

} // namespace ref
