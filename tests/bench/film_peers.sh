#!/usr/bin/env bash
# One cloud of 99 856 particles, 1920 x 1080, drawn by LAMMPS, by VTK and by hibi: milliseconds per frame, and how
# many times longer the others take. Alternately, so that a busy machine is no one's fault.
#
#     tests/bench/film_peers.sh [HIBI]      default: build/release/hibi
#
# Installs nothing. Needs of Debian 12: lammps (lmp); python3-vtk9, and xvfb for it; a peer that is missing is left out.
# FRAMES=10 (of a peer; hibi draws ten times as many) and ROUNDS=3 can be set, and KEEP=DIR to keep a picture of each.
# A frame is
#   hibi     interpolating, drawing, reading back, overlay; and in a film: frames as PNG, H.264
#   VTK      vtkPointGaussianMapper, and reading back; no file
#   LAMMPS   dump image, one process, a sphere per particle; and PNG
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
hibi=$(realpath "${1:-$root/build/release/hibi}")
frames=${FRAMES:-10} rounds=${ROUNDS:-3}
film=$((10 * frames))  # so that compiling shaders, once, does not count
side=316
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat > cloud.toml <<EOF
version = 1
title   = "A cloud of particles"
[material.stuff]
density        = "2000 kg/m^3"
youngs_modulus = "10 GPa"
poissons_ratio = 0.2
[[body]]
name     = "cloud"
material = "stuff"
box      = [["0 m", "0 m"], ["$side mm", "$side mm"]]
spacing  = "1 mm"
[[fix]]
name  = "clamp"
where = "y < 1 mm"
hold  = ["x", "y"]
[[load]]
name     = "pull"
face     = "top"
force    = ["0 N", "100 kN"]
[run]
max_time = "10 us"
[view]
colour = { field = "displacement", map = "viridis" }
[movie]
duration = "$(awk "BEGIN { print $film / 25 }") s"
hold     = "0 s"
EOF

cat > in.cloud <<EOF
units       si
dimension   3
boundary    f f f
atom_style  atomic
lattice     sc 0.001
region      box block -1 $side -1 $side -1 1
create_box  1 box
region      sheet block 0 $((side - 1)) 0 $((side - 1)) 0 0
create_atoms 1 region sheet
mass        1 1e-6
velocity    all create 1e14 4711 loop geom
neigh_modify every 1000000 delay 1000000 check no
pair_style  zero 0.0011 nocoeff
pair_coeff  * *
fix         1 all nve
timestep    1e-12
dump        1 all image 1 lammps.*.png vx type adiam 0.001 size 1920 1080 view 0 0 zoom 1.85 box no 0.0
dump_modify 1 pad 4 first no
thermo      1000000
run         $frames
EOF

cat > cloud.py <<EOF
import sys
import time
import vtk

side, frames = $side, $frames
data = vtk.vtkPolyData()
points = vtk.vtkPoints()
points.SetNumberOfPoints(side * side)
values = vtk.vtkFloatArray()
values.SetNumberOfTuples(side * side)
data.SetPoints(points)
data.GetPointData().SetScalars(values)
mapper = vtk.vtkPointGaussianMapper()
mapper.SetInputData(data)
mapper.SetScaleFactor(0.5e-3)
mapper.EmissiveOff()
mapper.SetSplatShaderCode(
    "//VTK::Color::Impl\n"
    "float d = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
    "if (d > 1.0) discard;\n")
mapper.SetScalarRange(0, side * 1e-3)
actor = vtk.vtkActor()
actor.SetMapper(mapper)
renderer = vtk.vtkRenderer()
renderer.AddActor(actor)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetSize(1920, 1080)
window.AddRenderer(renderer)
grabber = vtk.vtkWindowToImageFilter()
grabber.SetInput(window)
grabber.ReadFrontBufferOff()
grabber.ShouldRerenderOff()
renderer.GetActiveCamera().ParallelProjectionOn()
times = []
for k in range(frames + 1):
    for i in range(side * side):
        x, y = i % side * 1e-3, i // side * 1e-3 * (1 + 1e-3 * k)
        points.SetPoint(i, x, y, 0)
        values.SetValue(i, y)
    points.Modified()
    values.Modified()
    data.Modified()
    if k == 0:
        renderer.ResetCamera()
        renderer.GetActiveCamera().SetParallelScale(side * 0.5e-3 * 1.1)
    begin = time.perf_counter()
    window.Render()
    grabber.Modified()
    grabber.Update()
    if k > 0: times.append(time.perf_counter() - begin)  # the first one compiles shaders
if "--write" in sys.argv:
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(grabber.GetOutputPort())
    writer.SetFileName("vtk.png")
    writer.Write()
print(1000 * sum(times) / len(times))
EOF

"$hibi" run cloud.toml -o run --no-pictures -q > run.log

# Milliseconds per frame of the stages of the drawing thread that run.json lists.
hibi_frame() {
    "$hibi" render run --scene cloud.toml --no-report --profile -q > render.log
    python3 - "$film" <<'EOF'
import json, sys
run = json.load(open("run/run.json"))
drawing = ("interpolate", "place symbols", "upload", "draw calls", "rasterise", "read back", "overlay")
stages = {s["stage"]: s for s in run["profile"]["draw"]}
frames = int(sys.argv[1])
print(1000 * sum(stages[s]["seconds"] for s in drawing if s in stages) / frames,
      1000 * run["seconds"]["draw"] / frames)
EOF
}
lammps_frame() { lmp -in in.cloud -log lammps.log > /dev/null && awk -v n="$frames" '/^Output/ { print 1000 * $3 / n }' lammps.log; }
vtk_frame() { xvfb-run -a -s "-screen 0 1920x1080x24" /usr/bin/python3 cloud.py "$@" | tail -1; }

have() { command -v "$1" > /dev/null || { echo "left out: no $1; Debian package $2" >&2; return 1; }; }
peers=()
have lmp lammps && peers+=(lammps)
if have xvfb-run xvfb && { /usr/bin/python3 -c "import vtk" 2> /dev/null || { echo "left out: no VTK; Debian package python3-vtk9" >&2; false; }; }; then
    peers+=(vtk)
fi

for ((round = 0; round < rounds; ++round)); do
    hibi_frame >> hibi.ms
    for peer in "${peers[@]}"; do "${peer}_frame" >> "$peer.ms"; done
done
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
own=$(awk '{ print $1 }' hibi.ms | median)
printf '%-28s %8.1f ms per frame\n' hibi "$own"
printf '%-28s %8.1f ms per frame\n' "hibi, film of PNG and H.264" "$(awk '{ print $2 }' hibi.ms | median)"
for peer in "${peers[@]}"; do
    time=$(median < "$peer.ms")
    printf '%-28s %8.1f ms per frame, %5.1f times hibi\n' "$peer" "$time" "$(awk "BEGIN { print $time / $own }")"
done
if [ -n "${KEEP:-}" ]; then  # the pictures, to see that all draw the same
    [[ " ${peers[*]} " != *" vtk "* ]] || vtk_frame --write > /dev/null
    mkdir -p "$KEEP"
    for picture in run/poster.png lammps.0001.png vtk.png; do
        [ ! -e "$picture" ] || cp "$picture" "$KEEP"
    done
fi
