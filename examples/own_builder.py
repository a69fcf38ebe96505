"""A builder without linking, for: plumbline check-builder -- python3 examples/own_builder.py {primitives} {tree}
It splits at the median of the centres, along the longest axis."""

import json
import math
import struct
import sys

with open(sys.argv[1], "rb") as file:
    boxes = list(struct.iter_unpack("<6f", file.read()[128:]))  # min x y z, max x y z, after the header of .npy
if not all(math.isfinite(number) for box in boxes for number in box):
    sys.exit("a coordinate is not finite")
nodes = []


def build(primitives):
    """The number of the node over these primitives."""
    bounds = [function(boxes[i][k] for i in primitives) for function, k in zip([min] * 3 + [max] * 3, range(6))]
    number = len(nodes)
    nodes.append({"box": bounds})
    if len(primitives) <= 4:
        nodes[number]["primitives"] = primitives
    else:
        axis = max(range(3), key=lambda k: bounds[k + 3] - bounds[k])
        primitives = sorted(primitives, key=lambda i: boxes[i][axis] + boxes[i][axis + 3])
        middle = len(primitives) // 2
        nodes[number]["children"] = [build(primitives[:middle]), build(primitives[middle:])]
    return number


if boxes:
    build(list(range(len(boxes))))
with open(sys.argv[2] + ".json", "w", encoding="utf-8") as file:
    json.dump({"nodes": nodes}, file)
