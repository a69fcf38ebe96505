#!/usr/bin/env bash
# pictures.sh PLUMBLINE FOLDER: renders small pictures with that program into the folder, and prints a hash of
# each file. Two builds whose output is equal compute the same bits: by each integrator, on the reference and
# on the fast path, with each material and emitter, with pictures of strategies, and after --resume.
set -euo pipefail
program=$(realpath "$1")
scenes=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../scenes" && pwd)
rm -rf "$2"
mkdir -p "$2"
cd "$2"

render() { "$program" render "$scenes/$1.dae" -q --size 48x32 "${@:2}"; }

for device in ref host; do
    for integrator in path bdpt light; do
        for scene in cornell_glass all_emitters mesh_knot; do
            render $scene --integrator $integrator --device $device --deterministic -s 16 \
                -o "$scene.$integrator.$device.exr"
        done
    done
    # Few options differ from the default above.
    render cornell_glass --integrator bdpt --device $device --deterministic -s 16 --heuristic power --max-edges 5 \
        --strategies "strategies.$device.exr" --unweighted -o "power.$device.exr" -o "power.$device.png"
    render cornell_diffuse --integrator bdpt --device $device --deterministic -s 8 -o "resumed.$device.exr"
    render cornell_diffuse --integrator bdpt --device $device --deterministic -s 24 --resume \
        -o "resumed.$device.exr"
    render cornell_diffuse --integrator bdpt --device $device --deterministic -s 24 --keep-batches \
        -o "batches.$device.exr" -o "batches.$device.pfm"
done
sha256sum -- *.exr *.pfm *.png
