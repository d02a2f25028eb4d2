#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/picture/frame.hpp"

namespace diurna {

/// A hyperspectral cube: spectral radiance at the aperture in many narrow channels.
struct Cube {
    int width = 0, height = 0;
    Instant instant{};
    std::string observer;
    std::vector<double> wavelength_um, width_um;  // (channel) middle and width, ascending
    std::vector<std::vector<float>> radiance;  // (channel)(row, column) [W m⁻² sr⁻¹ µm⁻¹]

    std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
};

/// The cube of a frame rendered in `channels` (channel_bands): each channel's band radiance over
/// its width. Throws InputError if a channel is not among the frame's planes.
Cube cube_of(const Frame& frame, std::span<const Band> channels);

/// Name of a channel in the spectral OpenEXR layout (Fichet, Pacanowski & Wilkie, "An OpenEXR
/// layout for spectral images", JCGT 10(3), 2021): "S0.08050,000nm". Padded with zeros to the same
/// length, because OpenEXR stores channels in alphabetical order.
std::string spectral_channel_name(double wavelength_um);

/// The cube in that layout, to be written by write_exr(): planes S0.WAVELENGTHnm of spectral
/// radiance per nanometre [W m⁻² sr⁻¹ nm⁻¹], attributes spectralLayoutVersion and emissiveUnits
/// (the layout allows only "W.m^-2.sr^-1") and radianceUnits, the actual unit of the numbers.
Frame spectral_frame(const Cube& cube);

/// Writes the cube as an ENVI raster: `path` (.img, 32-bit floats, little-endian, band sequential)
/// and the text header beside it (.hdr) with wavelengths and widths in micrometres, radiance in
/// W m⁻² sr⁻¹ µm⁻¹. Throws std::runtime_error with path and reason.
void write_envi(const std::filesystem::path& path, const Cube& cube);

}  // namespace diurna
