#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "materials/radiation/spectrum.hpp"

namespace diurna {

/// An instrument's band and its quadrature: ∫ response(λ) f(λ) dλ ≈ Σ weight[i] f(node_um[i]).
///
/// The nodes are Gauss-Legendre points in every piece between breakpoints (those of the response
/// and those given, such as the edges of the atmosphere's bins), so the product of a function that
/// is constant per bin and a smooth one (Planck) is integrated to 1e-7 of its value or better.
struct Band {
    std::string name;             // "3-5"; part of plane and file names
    Spectrum response;            // 0 to 1
    std::vector<double> node_um;  // ascending
    std::vector<double> weight;   // [µm], response included
    double from_um() const { return response.wavelength_um.front(); }
    double to_um() const { return response.wavelength_um.back(); }
    double width_um() const;  // ∫ response dλ, the sum of the weights
};

/// A band of flat response 1 over [from_um, to_um], 0.2 to 100 µm.
Band flat_band(std::string name, double from_um, double to_um,
               std::span<const double> breakpoints_um = {}, int points_per_piece = 3);

/// A band from a response curve; pieces longer than `longest_piece_um` are divided.
Band response_band(std::string name, Spectrum response, std::span<const double> breakpoints_um = {},
                   int points_per_piece = 3, double longest_piece_um = 0.25);

/// Reads a response curve for response_band(): a CSV file of two columns, `wavelength_um` or
/// `wavelength_nm` and `response`, wavelengths ascending within 0.2 to 100 µm, responses 0 to 1 and
/// not all zero. Zeros beyond the curve's ends are skipped. Throws InputError with file, line and
/// column.
Spectrum read_response(const std::filesystem::path& path);

/// `count` adjacent bands of flat response and equal width from `from_um` to `to_um`: the channels
/// of a hyperspectral cube. Named by their middle, "8.025um".
std::vector<Band> channel_bands(double from_um, double to_um, int count,
                                std::span<const double> breakpoints_um = {});

/// Σ weight · value over a band's nodes: ∫ response · f dλ; and the mean weighted by the response.
double band_sum_nodes(const Band& band, std::span<const double> per_node);
double band_mean_nodes(const Band& band, std::span<const double> per_node);

/// Parses "3:5" or "3-5" [µm]; throws InputError if it is not an ascending range in 0.2 to 100.
Band parse_band(const std::string& text, std::span<const double> breakpoints_um = {});

}  // namespace diurna
