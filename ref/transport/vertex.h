#pragma once

// The vertices of paths, of which both walks consist and over which the weights sum.

#include "ref/transport/bsdf.h"
#include "ref/transport/world.h"

#include <glm/geometric.hpp>

namespace ref {

/// One vertex x_i of a path.
struct Vertex {
    enum class Kind {
        eye,     // the pinhole
        surface, // a point of a primitive, which may be an emitter
        source,  // a point or spot light
        infinity // a directional light or the environment
    };
    Kind kind;
    SurfacePoint point;     // where; of `eye` and `source` the position alone, of `infinity` nothing
    Vec3 towards;           // of `infinity`: the unit direction from the scene to it
    const Emitter* emitter; // that the vertex is a point of, or none
    Rgb alpha; // weight of the walk that made it [Veach 1997, sec. 10.2]: f |cos| / p so far
};

inline Vertex eye_vertex(const World& world)
{
    Vertex vertex{Vertex::Kind::eye, {}, Vec3(0.0), nullptr, Rgb(1.0)};
    vertex.point.position = world.camera.eye();
    return vertex;
}

inline Vertex surface_vertex(const World& world, const SurfacePoint& point, const Rgb& alpha)
{
    return {Vertex::Kind::surface, point, Vec3(0.0), world.emitters.of_primitive(point.primitive),
            alpha};
}

inline Vertex source_vertex(const Emitter& emitter, const Vec3& position, const Rgb& alpha)
{
    Vertex vertex{Vertex::Kind::source, {}, Vec3(0.0), &emitter, alpha};
    vertex.point.position = position;
    return vertex;
}

inline Vertex infinity_vertex(const Emitter& emitter, const Vec3& towards, const Rgb& alpha)
{
    return {Vertex::Kind::infinity, {}, towards, &emitter, alpha};
}

/// The unit direction in which `to` is seen from `from`. At most one of them is at infinity.
inline Vec3 direction(const Vertex& from, const Vertex& to)
{
    if (to.kind == Vertex::Kind::infinity) return to.towards;
    if (from.kind == Vertex::Kind::infinity) return -from.towards;
    return glm::normalize(to.point.position - from.point.position);
}

/// |cos| between the surface normal at `vertex` and the unit direction `w`; 1 where there is no surface.
inline double cosine(const Vertex& vertex, const Vec3& w)
{
    return vertex.kind == Vertex::Kind::surface ? std::abs(glm::dot(vertex.point.normal, w)) : 1.0;
}

/// The geometric term between two vertices: cosines at both over the square of the distance. A vertex at
/// infinity counts neither distance nor cosine, and one without a surface no cosine. At the eye that
/// leaves out a factor of G: camera.h says where it is.
inline double geometric_term(const Vertex& a, const Vertex& b)
{
    const Vec3 w = direction(a, b);
    if (a.kind == Vertex::Kind::infinity) return cosine(b, w);
    if (b.kind == Vertex::Kind::infinity) return cosine(a, w);
    const Vec3 d = b.point.position - a.point.position;
    return cosine(a, w) * cosine(b, w) / glm::dot(d, d); // map: geometric-term [Veach 1997, sec. 8.1]
}

inline const scenes::Material& material_at(const World& world, const Vertex& vertex)
{
    return world.scene.materials[vertex.point.material];
}

/// Whether light that arrives at `vertex` is spread over a whole range of directions: only then can it
/// be joined to a vertex that was found without it.
inline bool scatters(const World& world, const Vertex& vertex)
{
    return vertex.kind == Vertex::Kind::surface && !is_delta(material_at(world, vertex));
}

/// The BSDF at `vertex` for light between `a` and `b`, without delta lobes.
inline Rgb evaluate_bsdf(const World& world, const Vertex& a, const Vertex& vertex, const Vertex& b)
{
    const Frame frame(vertex.point.normal);
    return evaluate_bsdf(material_at(world, vertex), frame.to_local(direction(vertex, a)),
                         frame.to_local(direction(vertex, b)));
}

} // namespace ref
