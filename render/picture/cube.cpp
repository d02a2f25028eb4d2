#include "render/picture/cube.hpp"

#include <fmt/format.h>

#include <bit>
#include <span>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/made_by.hpp"

namespace diurna {

Cube cube_of(const Frame& frame, std::span<const Band> channels) {
    Cube cube{.width = frame.width,
              .height = frame.height,
              .instant = frame.instant,
              .observer = frame.observer,
              .wavelength_um = {},
              .width_um = {},
              .radiance = {}};
    for (const Band& channel : channels) {
        const Plane& plane = frame["radiance." + channel.name];
        const double width = channel.width_um();
        std::vector<float> radiance(plane.pixel.size());
        for (std::size_t p = 0; p < radiance.size(); ++p) {
            radiance[p] = static_cast<float>(double{plane.pixel[p]} / width);
        }
        cube.wavelength_um.push_back(0.5 * (channel.from_um() + channel.to_um()));
        cube.width_um.push_back(width);
        cube.radiance.push_back(std::move(radiance));
    }
    return cube;
}

std::string spectral_channel_name(double wavelength_um) {
    std::string name = fmt::format("S0.{:09.3f}nm", 1e3 * wavelength_um);
    name[name.rfind('.')] = ',';  // a point would begin another layer
    return name;
}

Frame spectral_frame(const Cube& cube) {
    Frame frame;
    frame.width = cube.width;
    frame.height = cube.height;
    frame.instant = cube.instant;
    frame.observer = cube.observer;
    frame.attributes = {{"spectralLayoutVersion", "1.0"},
                        {"emissiveUnits", "W.m^-2.sr^-1"},
                        {"radianceUnits", "W.m^-2.sr^-1.nm^-1"}};
    for (std::size_t c = 0; c < cube.radiance.size(); ++c) {
        Plane plane{spectral_channel_name(cube.wavelength_um[c]), "W m-2 sr-1 nm-1",
                    cube.radiance[c]};
        for (float& value : plane.pixel) value *= 1e-3f;
        frame.planes.push_back(std::move(plane));
    }
    return frame;
}

void write_envi(const std::filesystem::path& path, const Cube& cube) {
    static_assert(std::endian::native == std::endian::little);
    std::vector<float> values;
    values.reserve(cube.pixels() * cube.radiance.size());
    for (const auto& plane : cube.radiance) {
        values.insert(values.end(), plane.begin(), plane.end());
    }
    std::string wavelengths, widths;
    for (std::size_t c = 0; c < cube.radiance.size(); ++c) {
        const char* separator = c == 0 ? " " : ",\n ";
        wavelengths += fmt::format("{}{:.6f}", separator, cube.wavelength_um[c]);
        widths += fmt::format("{}{:.6f}", separator, cube.width_um[c]);
    }
    const std::string header = fmt::format(
        "ENVI\n"
        "description = {{{}: spectral radiance at the aperture, W m-2 sr-1 um-1, observer {}, "
        "{}}}\n"
        "samples = {}\n"
        "lines = {}\n"
        "bands = {}\n"
        "header offset = 0\n"
        "file type = ENVI Standard\n"
        "data type = 4\n"
        "interleave = bsq\n"
        "byte order = 0\n"
        "wavelength units = Micrometers\n"
        "wavelength = {{\n{}}}\n"
        "fwhm = {{\n{}}}\n",
        made_by(), cube.observer, format_instant(cube.instant), cube.width, cube.height,
        cube.radiance.size(), wavelengths, widths);
    write_whole_file(path, std::as_bytes(std::span(values)));
    std::filesystem::path beside = path;
    write_whole_file(beside.replace_extension(".hdr"), std::string_view(header));
}

}  // namespace diurna
