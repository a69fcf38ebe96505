"""The triangles of a COLLADA mesh. Polygons must be convex, so that every triangulation is the same surface."""

from vectors import cross, dot, subtract


def read_parts(document, geometry):
    """Pairs (symbol of the material, triangles) of the <polylist> and <triangles> of a geometry."""
    mesh = document.child(geometry, "mesh")
    for part in mesh:
        name = document.name(part)
        if name in ("polylist", "triangles"):
            yield part.get("material"), _triangles(document, part, name)
        elif name not in ("source", "vertices", "extra"):
            raise document.problem(part, "not supported here")


def _triangles(document, part, name):
    vertex_input, stride = _layout(document, part)
    points = _points(document, document.target(vertex_input, "source"))
    indices = list(map(int, document.child(part, "p").text.split()))[int(vertex_input.get("offset", 0))::stride]
    if name == "polylist":
        sizes = list(map(int, document.child(part, "vcount").text.split()))
    else:
        sizes = [3] * (len(indices) // 3)
    if sum(sizes) != len(indices) or max(indices, default=-1) >= len(points):
        raise document.problem(part, "its indices do not fit together")
    triangles, first = [], 0
    for size in sizes:
        corners = [points[i] for i in indices[first:first + size]]
        first += size
        fan = [(corners[0], corners[i], corners[i + 1]) for i in range(1, size - 1)]
        if not _is_convex(corners):
            raise document.problem(part, "a polygon that is not convex is not supported here")
        triangles += fan
    return triangles


def _layout(document, part):
    inputs = document.children(part, "input")
    vertex = [each for each in inputs if each.get("semantic") == "VERTEX"]
    if len(vertex) != 1:
        raise document.problem(part, "no <input> for VERTEX")
    return vertex[0], 1 + max(int(each.get("offset", 0)) for each in inputs)


def _points(document, vertices):
    position = next((each for each in document.children(vertices, "input") if each.get("semantic") == "POSITION"), None)
    if position is None:
        raise document.problem(vertices, "no POSITION")
    source = document.target(position, "source")
    accessor = document.child(document.child(source, "technique_common"), "accessor")
    if int(accessor.get("stride", 1)) != 3 or int(accessor.get("offset", 0)) != 0:
        raise document.problem(source, "positions with a stride of 3 are expected")
    values = document.numbers(document.target(accessor, "source"))
    return list(zip(values[0::3], values[1::3], values[2::3]))


def _is_convex(corners):
    if len(corners) == 3:
        return True
    turns = []
    for i, corner in enumerate(corners):
        following, last = corners[(i + 1) % len(corners)], corners[i - 1]
        turns.append(cross(subtract(corner, last), subtract(following, corner)))
    return all(dot(turn, turns[0]) > 0 for turn in turns)
