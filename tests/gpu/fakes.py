"""A build and tools of NVIDIA's that only print, for day_test.py: what they print is in the format of the real ones."""
import os
import shutil
import sys
from pathlib import Path

SMI = """case "$1" in -L) echo 'GPU 0: NVIDIA H100 80GB HBM3 (UUID: GPU-0)';; *) echo 'NVIDIA H100 80GB HBM3, 580.1, 81559 MiB';; esac"""

PLUMBLINE = """
case "$1" in
--version) echo plumbline 0.1.0; echo 'GPU: NVIDIA H100 80GB HBM3, sm_90, driver for CUDA 13.0, 79 GiB';;
render) echo '{"device":"cuda","complete":true,"seconds":0.5,"samples_per_second":2e6,"mean_rgb":[0.5,0.4,0.3],"dropped":0,"black_despite_emitters":false}';;
bvh) echo '{"device":"cuda","plausible":true,"primitives":20498,"bytes_per_second":3e12,"builders":[{"name":"morton30","ms":0.25,"bytes_per_primitive":272.0,"stages":[{"name":"sort","ms":0.125,"percent_of_bandwidth":50.0}]}]}';;
esac"""

TESTS = """
[ "$PLUMBLINE_REQUIRE_GPU" = 1 ] || exit 3
echo '[ RUN      ] OnDevice.A'
echo '[       OK ] OnDevice.A (7 ms)'
echo '[ RUN      ] Every/LbvhOn.B/device30'
echo '[       OK ] Every/LbvhOn.B/device30 (12 ms)'"""

FAILING = TESTS + """
echo '[ RUN      ] Every/LbvhOn.C/device63'
echo 'Failure'
echo '[  FAILED  ] Every/LbvhOn.C/device63, where GetParam() = 8-byte object <03-00> (1 ms)'
echo '[  FAILED  ] 1 test, listed below:'
echo '[  FAILED  ] Every/LbvhOn.C/device63, where GetParam() = 8-byte object <03-00>'
exit 1"""

HANGING = TESTS + """
echo '[ RUN      ] OnDevice.Hangs'
sleep 60 &
echo $! >"$0.child"
sleep 60"""

CRASHING = TESTS + """
echo '[ RUN      ] OnDevice.Crashes'
kill -SEGV $$"""

ALL_SKIPPED = """
echo '[ RUN      ] OnDevice.A'
echo '[  SKIPPED ] OnDevice.A (0 ms)'
echo '[  SKIPPED ] 1 test, listed below:'
echo '[  SKIPPED ] OnDevice.A'"""

ONE_SKIPPED = TESTS + ALL_SKIPPED.replace("OnDevice.A", "OnDevice.D")

# Runs the program that it is given, as the real one does.
SANITIZER = """
shift 4
"$@" || exit $?
echo '========= ERROR SUMMARY: 0 errors'"""

SANITIZER_WITH_ERRORS = SANITIZER.replace("0 errors", "3 errors") + "\nexit 9"

SANITIZER_REFUSED = "echo '========= Error: Device not supported'"

NCU = r"""
echo '==PROF== Connected to process 1 (plumbline)'
echo '"ID","Kernel Name","Section Name","Metric Name","Metric Unit","Metric Value"'
for id in 0 1; do
    echo "\"$id\",\"void fast::run_kernel<fast::RenderSamples<1, 0>>(T1, unsigned int)\",\"Launch Statistics\",\"Registers Per Thread\",\"register/thread\",\"128\""
    echo "\"$id\",\"void fast::run_kernel<fast::RenderSamples<1, 0>>(T1, unsigned int)\",\"Launch Statistics\",\"Grid Size\",\"\",\"4,096\""
    echo "\"$id\",\"void fast::run_kernel<fast::RenderSamples<1, 0>>(T1, unsigned int)\",\"Occupancy\",\"Achieved Occupancy\",\"%\",\"24.5\""
    echo "\"$id\",\"void fast::run_kernel<fast::RenderSamples<1, 0>>(T1, unsigned int)\",\"GPU Speed Of Light Throughput\",\"Compute (SM) Throughput\",\"%\",\"40.25\""
done"""

NCU_REFUSED = "echo '==ERROR== ERR_NVGPUCTRPERM - The user does not have permission to access GPU counters'; exit 1"


def write_program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#!/bin/sh\n" + text + "\n", encoding="utf-8")
    path.chmod(0o755)


def make_build(folder):
    """A build in which everything passes."""
    write_program(folder / "plumbline", PLUMBLINE)
    write_program(folder / "tests/test_cuda", TESTS)
    write_program(folder / "tests/test_renders", TESTS)
    write_program(folder / "tests/test_extremes", TESTS)


def make_tools(folder):
    """Everything that a run finds on its PATH: the fakes, and the few programs of the system that it needs."""
    folder.mkdir(parents=True)
    for name in ("bash", "sh", "dirname", "sleep"):
        (folder / name).symlink_to(shutil.which(name))
    # The mesh takes seconds to write, and no fake reads it.
    write_program(folder / "python3", f'case "$1" in *mesh.py) exit 0;; esac; exec {os.path.realpath(sys.executable)} "$@"')
    for name, text in (("nvidia-smi", SMI), ("compute-sanitizer", SANITIZER), ("ncu", NCU)):
        write_program(folder / name, text)


def exists(process):
    """Whether a process is there and has not ended."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False
