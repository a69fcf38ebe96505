"""Writes triangles as a binary PLY file, which Mitsuba and LuxCore both read. No normals: surfaces are flat."""

import struct


def write_ply(path, triangles):
    indices = {}
    faces = [tuple(indices.setdefault(point, len(indices)) for point in triangle) for triangle in triangles]
    with open(path, "wb") as file:
        file.write(("ply\nformat binary_little_endian 1.0\n"
                    f"element vertex {len(indices)}\n"
                    "property float x\nproperty float y\nproperty float z\n"
                    f"element face {len(faces)}\n"
                    "property list uchar int vertex_indices\nend_header\n").encode())
        for point in indices:
            file.write(struct.pack("<3f", *point))
        for face in faces:
            file.write(struct.pack("<B3i", 3, *face))
