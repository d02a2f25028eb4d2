#include "render/picture/cube.hpp"

#include <gdal_priv.h>

#include <catch2/catch.hpp>
#include <random>

#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"
#include "render/picture/exr.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

/// Black bodies of 250 to 350 K in 12 channels from 8 to 11 µm.
Frame black_frame(const std::vector<Band>& channels) {
    Frame frame;
    frame.width = 7;
    frame.height = 5;
    frame.observer = "east";
    frame.instant = parse_instant("2026-07-15T12:00:00Z");
    for (const Band& channel : channels) {
        Plane plane{"radiance." + channel.name, "W m-2 sr-1", {}};
        for (std::size_t p = 0; p < frame.pixels(); ++p) {
            plane.pixel.push_back(float(band_radiance(channel, 250.0 + 3.0 * double(p))));
        }
        frame.planes.push_back(std::move(plane));
    }
    return frame;
}

}  // namespace

TEST_CASE("a cube's channels carry Planck's law at their wavelengths", "[render][cube]") {
    const std::vector<Band> channels = channel_bands(8.0, 11.0, 60);
    const Cube cube = cube_of(black_frame(channels), channels);
    REQUIRE(cube.radiance.size() == 60);
    for (std::size_t c = 0; c < 60; ++c) {
        CHECK(cube.wavelength_um[c] == Approx(8.025 + 0.05 * double(c)));
        CHECK(cube.width_um[c] == Approx(0.05));
        // The mean over 0.05 µm is the middle's value except for the curvature, (Δλ)² B'' / 24.
        CHECK(double{cube.radiance[c][20]} ==
              Approx(planck(cube.wavelength_um[c], 310.0)).epsilon(2e-5));
    }
    CHECK_THROWS_AS(cube_of(black_frame(channels), channel_bands(3.0, 4.0, 2)), InputError);
}

TEST_CASE("an ENVI cube is read back by GDAL with its wavelengths",
          "[render][cube][by_comparison]") {
    const ScratchFolder folder("cube");
    const std::vector<Band> channels = channel_bands(8.0, 11.0, 12);
    const Cube cube = cube_of(black_frame(channels), channels);
    const auto path = folder.path / "east.img";
    write_envi(path, cube);
    GDALAllRegister();
    const std::unique_ptr<GDALDataset> raster(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
    REQUIRE(raster);
    CHECK(std::string(raster->GetDriverName()) == "ENVI");
    REQUIRE(raster->GetRasterCount() == 12);
    REQUIRE(raster->GetRasterXSize() == 7);
    REQUIRE(raster->GetRasterYSize() == 5);
    std::vector<float> plane(cube.pixels());
    for (int b = 0; b < 12; ++b) {
        GDALRasterBand* band = raster->GetRasterBand(b + 1);
        REQUIRE(band->RasterIO(GF_Read, 0, 0, 7, 5, plane.data(), 7, 5, GDT_Float32, 0, 0) ==
                CE_None);
        CHECK(plane == cube.radiance[std::size_t(b)]);
        const char* um = band->GetMetadataItem("wavelength");
        REQUIRE(um != nullptr);
        CHECK(std::stod(um) == Approx(8.125 + 0.25 * b));
        CHECK(std::string(band->GetMetadataItem("wavelength_units")) == "Micrometers");
    }
}

TEST_CASE("the spectral OpenEXR layout names its channels by wavelength", "[render][cube]") {
    CHECK(spectral_channel_name(0.55) == "S0.00550,000nm");
    CHECK(spectral_channel_name(8.05) == "S0.08050,000nm");
    CHECK(spectral_channel_name(12.0) == "S0.12000,000nm");
    const ScratchFolder folder("cube");
    const std::vector<Band> channels = channel_bands(9.0, 11.0, 8);
    const Cube cube = cube_of(black_frame(channels), channels);
    write_exr(folder.path / "cube.exr", spectral_frame(cube), ExrCompression::piz);
    const Frame back = read_exr(folder.path / "cube.exr");
    REQUIRE(back.planes.size() == 8);
    CHECK(back.attributes.at("spectralLayoutVersion") == "1.0");
    CHECK(back.attributes.at("emissiveUnits") == "W.m^-2.sr^-1");
    CHECK(back.attributes.at("radianceUnits") == "W.m^-2.sr^-1.nm^-1");
    for (std::size_t c = 0; c < 8; ++c) {  // alphabetical is ascending
        CHECK(back.planes[c].name == spectral_channel_name(cube.wavelength_um[c]));
        CHECK(back.planes[c].pixel[3] == Approx(1e-3f * cube.radiance[c][3]));
    }
}
