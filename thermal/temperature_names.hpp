#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "thermal/heat_flux_field.hpp"
#include "thermal/surface/surface_cover.hpp"

/// Names in files of temperatures that their writer and their reader share.
namespace diurna {

/// Names of a SurfaceCover in the file.
struct CoverName {
    const char *name, *standard_name, *long_name;
    float SurfaceCover::*value;
};
inline constexpr std::array<CoverName, 3> cover_names{{
    {"wet_share", "", "wet share of the facet: content divided by capacity of its store",
     &SurfaceCover::wet},
    {"snow_cover", "surface_snow_area_fraction", "share of the facet covered by snow or hoar",
     &SurfaceCover::snow},
    {"snow_albedo", "", "broadband albedo of that snow; 0 without snow",
     &SurfaceCover::snow_albedo},
}};

/// Names of a term in the file. CF names fluxes away from the ground "upward"; here that is away
/// from the facet.
struct TermName {
    const char *name, *standard_name, *long_name;
};
inline constexpr std::array<TermName, heat_terms> heat_term_names{{
    {"absorbed_sunlight", "surface_net_downward_shortwave_flux",
     "sunlight absorbed by the facet, without transmitted sunlight"},
    {"absorbed_longwave", "", "longwave of sky and other facets absorbed by the facet"},
    {"internal_heat", "", "heat released at the facet's surface"},
    {"emitted_longwave", "", "longwave emitted by the facet"},
    {"sensible_heat", "surface_upward_sensible_heat_flux", "sensible heat flux to the air"},
    {"latent_heat", "surface_upward_latent_heat_flux", "latent heat flux by vapour"},
    {"melting_heat", "",
     "heat absorbed by melting frost on the surface; negative: heat released by freezing"},
    {"conducted_heat", "",
     "heat conducted to the layers below, including their storage, as the conduction solver "
     "computes it"},
}};

inline constexpr const char* temperatures_title = "diurna facet temperatures";
inline constexpr const char* solved_as_name = "solved_as";
/// Attribute of it: TemperatureField::representative_rms.
inline constexpr const char* representative_rms_name = "representative_rms_K";
inline constexpr const char* made_of_name = "made_of";  // global attribute, FieldNotes::made_of

/// HDF5 stores no larger attribute in the normal way: longer lists of names become a variable
/// NAME_name instead.
inline constexpr std::size_t most_attribute_bytes = 60000;

/// A word of CF's flag_meanings: letters, digits and _ - . + @, else "_".
inline std::string flag_word(std::string name) {
    for (char& c : name) {
        const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') ||
                          std::string_view("_-.+@").find(c) != std::string_view::npos;
        if (!good) c = '_';
    }
    return name.empty() ? "_" : name;
}

}  // namespace diurna
