#pragma once

namespace hibi {

/// A scene that uses every key that is available.
inline constexpr const char* everything =
    R"scene(# Everything a scene can hold, for tests of reading and writing.
version = 1
title = "ひび \"everything\""
about = """two
lines"""
[params]
spacing = "0.5 m"
width = "10 m"
half = "width / 2"
speed = "3 m/s"
count = 4
[model]
dimension = 2
assumption = "plane strain"
thickness = "20 cm"
influence = 2.3
elasticity = "thesis"
[material.concrete]
density = "2.3 g/cm^3"
youngs_modulus = "30 GPa"
poissons_ratio = 0.2
break_strain = "0.1 percent"
tension_only = true
weibull = { shape = 12, seed = 7 }
[material."odd name"]
density = 1000
youngs_modulus = "1 GPa"
poissons_ratio = 0
fracture_energy = "100 J/m^2"
[[body]]
name = "plate"
material = "concrete"
box = [["0 m", "0 m"], ["width", "half"]]
spacing = "spacing"
[[body]]
name = "glued"
material = "odd name"
box = [["width", "0 m"], ["width + count*spacing", "half"]]
spacing = "spacing"
bonded_to = ["plate"]
[[body]]
name = "disc"
material = "concrete"
disc = { centre = ["30 m", "0 m"], radius = "2 m" }
spacing = "0.25 m"
lattice = { angle = "30 deg", jitter = 0.1, seed = 3 }
velocity = ["-speed", "speed * (x - 30 m) / (2 m)"]
spin = "30 rpm"
[[body]]
material = "concrete"
ring = { centre = ["40 m", "0 m"], inner = "1 m", outer = "3 m" }
spacing = "0.25 m"
[[body]]
name = "triangle"
material = "concrete"
polygon = [["50 m", "0 m"], ["54 m", "0 m"], ["50 m", "3 m"]]
spacing = "0.25 m"
[[body]]
name = "holed"
material = "concrete"
difference = [
  { box = [["60 m", "0 m"], ["64 m", "4 m"]] },
  { disc = { centre = ["62 m", "2 m"], radius = "1 m" } },
  { polygon = [["60 m", "0 m"], ["61 m", "0 m"], ["60 m", "1 m"]] },
  { ring = { centre = ["63 m", "3 m"], inner = "0.1 m", outer = "0.4 m" } }]
spacing = "0.25 m"
[[notch]]
name = "slit"
line = [["5 m", "5 m"], ["5 m", "4 m"]]
body = "plate"
[[notch]]
polyline = [["2 m", "5 m"], ["2 m", "4 m"], ["2.5 m", "3.5 m"]]
[[fix]]
name = "clamp"
where = "x < spacing and not (y > 4.9 m or y < -1 m)"
hold = ["x", "y"]
[[fix]]
body = "holed"
hold = ["y"]
[[load]]
name = "wind"
where = "hypot(x - 11 m, y - 2 m) < 1 m"
force = ["2 kN * (1 + sin(2*pi*t/(3 s)))", "-1 kN * (y/(1 m))^2"]
ramp = "2 s"
until = "first_break - 1 ms"
[[load]]
name = "push"
face = "top"
body = "plate"
pressure = "2 MPa * exp(-t/(1 s)) * step(t - 10 ms)"
primary = true
no_fail = true
until = 3
[[load]]
name = "pull"
face = "right"
body = "glued"
force = ["1 kN", 0]
[[load]]
name = "drive"
body = "triangle"
displacement = ["1 mm", "free"]
[[load]]
name = "blow"
where = "x > 40 m and atan2(y, x - 40 m) > 0"
body = "body4"
pressure = "1 kPa"
[[load]]
name = "drag"
where = "x > 62 m"
body = "holed"
velocity = ["0.1 m/s * min(1, t/(1 s), 2)", "free"]
[gravity]
acceleration = [0, "-9.81 m/s^2"]
[damping]
rate = "0.5/s"
until = "peak_load + 2"
[run]
until = "separation + 0.5 s"
max_time = "1 min"
method = "explicit"
time_step_factor = 0.4
[view]
size = [1280, 720]
colour = { field = "von_mises", map = "viridis", range = ["0 MPa", "20 MPa"] }
theme = "light"
background = "transparent"
show = ["title", "time"]
window = [["-1 m", "-1 m"], ["70 m", "20 m"]]
bonds = "all"
magnify = 10
[movie]
duration = "8 s"
fps = 30
slow = [{ around = "first_break", span = "0.5 s", rate = 0.05 },
        { around = "2 s", span = "10 ms", rate = 0.1 }]
hold = "0.5 s"
flash = "0.4 s"
poster = "peak_load"
formats = ["mp4", "gif"]
gif_limit = 4

[strip]
at = ["first_break", "separation + 0.2 s", "3 s"]
[test]
size = [480, 270]
frames = ["first_break", "peak_load - 1 ms", 2]
params = ["spacing=1 m", "count=2"]
tolerance = { tile = 4, pixels = 20, mean = 1, rmse = 2, position = 0.1, break_steps = 2, load = 0.01 }
)scene";

/// The least that runs: 40 m x 20 m plate of 4 m particles, clamped on the left, pulled down at the right.
inline constexpr const char* small_scene = R"scene(version = 1
title = "small"
[params]
spacing = "4 m"
[material.concrete]
density = "2300 kg/m^3"
youngs_modulus = "210 MPa"
poissons_ratio = 0.3
break_strain = 0.1
[[body]]
name = "plate"
material = "concrete"
box = [["0 m", "0 m"], ["40 m", "20 m"]]
spacing = "spacing"
[[fix]]
name = "clamp"
where = "x < spacing"
hold = ["x", "y"]
[[load]]
name = "tip"
where = "x > 40 m - spacing"
force = ["0 N", "-80 MN"]
ramp = "40 s"
[run]
until = "separation + 0.5 s"
max_time = "60 s"
)scene";

}  // namespace hibi
