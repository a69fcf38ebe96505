"""A scene as plain data, in world space, with the conventions of scenes/scene.h."""

from dataclasses import dataclass, field

from vectors import add, length, scaled, subtract


@dataclass(frozen=True)
class Material:
    """kind: lambertian (color: albedo), mirror (color: reflectance), emission (color: radiance, on the side of
    the normal), or glass (color: reflectance, transmittance, ior)."""
    kind: str
    color: tuple
    transmittance: tuple = (1.0, 1.0, 1.0)
    ior: float = 1.0


@dataclass
class Camera:
    """Looks along -backward; fov in degrees along fov_axis, "x" or "y"."""
    eye: tuple
    right: tuple
    up: tuple
    backward: tuple
    fov_axis: str
    fov: float


@dataclass
class Scene:
    name: str
    materials: list = field(default_factory=list)
    triangles: dict = field(default_factory=dict)  # by index of the material: lists of three points
    spheres: list = field(default_factory=list)  # (centre, radius, index of the material)
    camera: Camera = None

    def triangle_count(self):
        return sum(map(len, self.triangles.values()))


def frame_camera(scene):
    """What --frame of plumbline does (scenes/frame.h)."""
    points = [p for triangles in scene.triangles.values() for triangle in triangles for p in triangle]
    for center, radius, _ in scene.spheres:
        points += [subtract(center, (radius,) * 3), add(center, (radius,) * 3)]
    low = tuple(min(p[i] for p in points) for i in range(3))
    high = tuple(max(p[i] for p in points) for i in range(3))
    center = scaled(0.5, add(low, high))
    diagonal = length(subtract(high, low))
    scene.camera.eye = add(center, scaled(1.5 * diagonal, scene.camera.backward))
