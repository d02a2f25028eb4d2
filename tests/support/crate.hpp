#pragma once

#include <string>

/// A closed box of 4 x 4 x 2 m about the origin, z up, as an OBJ file.
inline const std::string crate_mesh = R"(v -2 -2 0
v 2 -2 0
v 2 2 0
v -2 2 0
v -2 -2 2
v 2 -2 2
v 2 2 2
v -2 2 2
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

/// It as an object of sheet, in a scene whose folder has `crate_mesh` as crate.obj; further keys
/// may follow.
inline const std::string crate_object = R"(
[[object]]
name = "crate"
mesh = "crate.obj"
up = "z"
material = "painted_sheet"
largest_edge_m = 2.0
)";
