"""Vectors of three numbers and affine transforms of three rows, as tuples."""

import math

IDENTITY = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0))


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(factor, a):
    return (factor * a[0], factor * a[1], factor * a[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scaled(1 / length(a), a)


def product(a, b):
    """The transform that applies b, then a."""
    last = (0.0, 0.0, 0.0, 1.0)
    rows = (*b, last)
    return tuple(tuple(sum(row[k] * rows[k][j] for k in range(4)) for j in range(4)) for row in a)


def translation(v):
    return tuple((*IDENTITY[i][:3], v[i]) for i in range(3))


def scaling(v):
    return tuple(tuple(v[i] if i == j else 0.0 for j in range(4)) for i in range(3))


def rotation(axis, degrees):
    """Rodrigues' formula."""
    u = unit(axis)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    skew = ((0, -u[2], u[1]), (u[2], 0, -u[0]), (-u[1], u[0], 0))
    return tuple(
        (*((c if i == j else 0.0) + (1 - c) * u[i] * u[j] + s * skew[i][j] for j in range(3)), 0.0)
        for i in range(3))


def point_at(matrix, p):
    return tuple(row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3] for row in matrix)


def column(matrix, i):
    return tuple(row[i] for row in matrix)


def is_mirrored(matrix):
    return dot(cross(column(matrix, 0), column(matrix, 1)), column(matrix, 2)) < 0
