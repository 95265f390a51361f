#!/bin/bash
# Steps of LAMMPS' peridynamics (peri/lps: two passes over the bonds, as here) and of this program on the same plate,
# 316 x 316 particles with r_e = 3.015 l0, in turn: the machine drifts, so only the ratio of a pair means something.
# usage: peer.sh [BUILD_DIR] [PAIRS]          needs Debian's lammps and openmpi-bin; THREADS="1 2" by default
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=${1:-$here/../../build/release} pairs=${2:-5}
command -v lmp mpirun >/dev/null || { echo "peer.sh: needs the Debian packages lammps and openmpi-bin" >&2; exit 1; }
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

peer() { # ranks -> bond-updates per second
    mpirun -np "$1" --oversubscribe --bind-to none lmp -in "$here/peer.lammps" -log none 2>&1 |
        awk '/total # of bonds/ { b = $NF / 2 } /^Loop time/ { t = $4; s = $9 } END { printf "%.4g\n", b * s / t }'
}
own() { # benchmark threads -> bond-updates per second
    "$build/tests/bench_steps" --benchmark_filter="step/$1/particles:100000/re:3015/threads:$2/" \
        --benchmark_min_time=1 --benchmark_format=csv 2>/dev/null |
        awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k ~ /bond-updates/) c = k } END { printf "%.4g\n", $c }'
}

printf '%-8s %12s %12s %8s %12s %8s\n' threads peri/lps breakable ratio unbreakable ratio
for threads in ${THREADS:-1 2}; do
    for ((k = 0; k < pairs; ++k)); do
        p=$(peer "$threads") b=$(own breakable "$threads") u=$(own plain "$threads")
        awk -v t="$threads" -v p="$p" -v b="$b" -v u="$u" \
            'BEGIN { printf "%-8d %12.4g %12.4g %8.1f %12.4g %8.1f\n", t, p, b, b / p, u, u / p }'
    done
done
