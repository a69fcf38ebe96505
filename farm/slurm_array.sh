#!/usr/bin/env bash
#SBATCH --job-name=plumbline
#SBATCH --cpus-per-task=4
#SBATCH --requeue
# slurm_array.sh SCENE FOLDER SAMPLES [option of plumbline render...]: renders one picture as an array job of SLURM, for sites without
# Python at the workers. The elements share the batches; their parts go into FOLDER, which all machines see. A part that is there is not
# rendered again: the same job, submitted again with as many elements, renders what is missing.
#
#   sbatch --array=0-63 farm/slurm_array.sh scenes/cornell_glass.dae shared/glass 16384 --size 1920x1080
#   plumbline merge shared/glass/batches_*.exr -o glass.exr -s 16384                       # when all elements are done
#
# A golden: first its pilot by one element, then the rest by the array:
#
#   GOLDEN=pilot sbatch --wait --array=0 farm/slurm_array.sh scenes/cornell_glass.dae shared/golden 16384
#   GOLDEN=rest sbatch --wait --array=0-63 farm/slurm_array.sh scenes/cornell_glass.dae shared/golden 16384
#   plumbline merge shared/golden/{pilot,batches_*}.exr -o golden/renders/cornell_glass.exr -s 16384 --finish
#
# Environment: PLUMBLINE, the program (plumbline in the PATH); BATCH, samples in a batch (4); PILOT, batches of a golden's pilot (32);
# GOLDEN, pilot or rest; TASKS, how many elements there are, if SLURM does not say. By hand, without SLURM:
#
#   for i in 0 1 2 3; do SLURM_ARRAY_TASK_ID=$i TASKS=4 farm/slurm_array.sh scenes/cornell_glass.dae out/glass 256; done
set -euo pipefail
usage() {
    echo "slurm_array.sh: $1 (its head says how it is used)" >&2
    exit 2
}
[ $# -ge 3 ] || usage "SCENE FOLDER SAMPLES are needed"
scene=$1 folder=$2 samples=$3
shift 3
program=${PLUMBLINE:-plumbline} batch=${BATCH:-4} pilot=${PILOT:-32} tasks=${TASKS:-${SLURM_ARRAY_TASK_COUNT:-}}
[[ ${SLURM_ARRAY_TASK_ID:-} =~ ^[0-9]+$ ]] || usage "SLURM_ARRAY_TASK_ID is not set: this is an element of an array job"
for number in "$samples" "$batch" "$pilot" "$tasks"; do
    [[ $number =~ ^[1-9][0-9]*$ ]] || usage "'$number' is no number of samples, batches or elements"
done
index=$((SLURM_ARRAY_TASK_ID - ${SLURM_ARRAY_TASK_MIN:-0}))
[ "$index" -lt "$tasks" ] || usage "element $index of $tasks: elements begin at 0"
[ $((samples % batch)) -eq 0 ] || usage "$samples samples are not a whole number of batches of $batch"
[ -f "$scene" ] || usage "$scene: there is no such scene file"
mkdir -p "$folder"
options=(--batch "$batch" "$@")
[ -z "${SLURM_CPUS_PER_TASK:-}" ] || options+=(-t "$SLURM_CPUS_PER_TASK")

# part COMMAND BEGIN END FILE [OPTION...]: one part, unless it is there, whole.
part() {
    [ -f "$4" ] && "$program" merge --check "$4" >/dev/null && return
    local new=$folder/.element-$index-$$.tmp-${4##*/} # so that a part has its name only when it is whole
    rm -f "$4"
    "$program" "$1" "$scene" --batches "$2..$3" -o "$new" -q "${options[@]}" "${@:5}"
    mv "$new" "$4"
}

begin=0 end=$((samples / batch)) command=render more=()
case ${GOLDEN:-} in
    "") ;;
    pilot)
        [ "$index" -gt 0 ] || part golden 0 "$pilot" "$folder/pilot.exr" --pilot "$pilot" -s "$samples"
        exit 0 ;;
    rest) begin=$pilot command=golden more=(--pilot "$pilot" -s "$samples" --pilot-file "$folder/pilot.exr") ;;
    *) usage "GOLDEN=$GOLDEN: must be pilot or rest" ;;
esac
# Parts of a power of two, aligned, so that each holds one block of the film; at least four for each element, so that all take
# about the same time.
unit=1
while [ $((8 * unit * tasks)) -le $((end - begin)) ]; do unit=$((2 * unit)); done
for ((block = begin / unit + index; block * unit < end; block += tasks)); do
    first=$((block * unit > begin ? block * unit : begin))
    last=$(((block + 1) * unit < end ? (block + 1) * unit : end))
    part "$command" "$first" "$last" "$folder/$(printf 'batches_%08d-%08d.exr' "$first" "$last")" "${more[@]}"
done
