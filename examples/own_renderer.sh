#!/bin/sh
# A renderer with a command line of its own, for:
#   plumbline check-renderer -- examples/own_renderer.sh {scene} {out} {width} {height} {samples} {seed} {max_edges}
# Here it is the fast path of Plumbline itself, which must be on the PATH; put your own in its place.
exec plumbline render "$1" -o "$2" --size "$3x$4" -s "$5" --seed "$6" --max-edges "$7" --integrator bdpt --device host -q
