#pragma once

#include <array>

#include "thermal/surface/surface_cover.hpp"

/// Names in files of temperatures that their writer and their reader share.
namespace diurna {

/// What is written of a SurfaceCover.
struct CoverName {
    const char *name, *standard_name, *long_name;
    float SurfaceCover::*value;
};
inline constexpr std::array<CoverName, 3> cover_names{{
    {"wet_share", "", "share of the facet that is wet, content over capacity of what it holds",
     &SurfaceCover::wet},
    {"snow_cover", "surface_snow_area_fraction", "share of the facet that snow or hoar hides",
     &SurfaceCover::snow},
    {"snow_albedo", "", "broadband albedo of that snow; 0 where none lies",
     &SurfaceCover::snow_albedo},
}};

inline constexpr const char* solved_as_name = "solved_as";

}  // namespace diurna
