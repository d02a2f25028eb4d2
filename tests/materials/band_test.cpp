#include "materials/radiation/band.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

template <class F>
double integrate(const Band& band, F f) {
    double sum = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i)
        sum += band.weight[i] * f(band.node_um[i]);
    return sum;
}

}  // namespace

TEST_CASE("a flat band is as wide as its range", "[materials][band]") {
    const Band band = flat_band("8-12", 8.0, 12.0);
    CHECK(band.width_um() == Approx(4.0).epsilon(1e-14));
    CHECK(band.from_um() == 8.0);
    CHECK(band.to_um() == 12.0);
    CHECK(std::is_sorted(band.node_um.begin(), band.node_um.end()));
}

TEST_CASE("n points per piece integrate polynomials of degree 2n - 1 exactly",
          "[materials][band][by_comparison]") {
    const int points = GENERATE(1, 2, 3, 4, 5, 8);
    const Band band = flat_band("", 1.0, 1.2, {}, points);
    const int degree = 2 * points - 1;
    const double exact = (std::pow(1.2, degree + 1) - 1.0) / (degree + 1);
    CAPTURE(points);
    CHECK(integrate(band, [&](double um) { return std::pow(um, degree); }) ==
          Approx(exact).epsilon(1e-13));
}

TEST_CASE("a function that jumps at a breakpoint is integrated exactly",
          "[materials][band][by_comparison]") {
    const std::vector<double> breaks = {2.0, 3.3333, 4.7, 9.0};
    const Band band = flat_band("", 3.0, 5.0, breaks);
    const auto step = [](double um) { return um < 3.3333 ? 1.0 : um < 4.7 ? 0.25 : 2.0; };
    CHECK(integrate(band, step) ==
          Approx(0.3333 + 0.25 * (4.7 - 3.3333) + 2.0 * 0.3).epsilon(1e-13));
}

TEST_CASE("breakpoints do not change a smooth integral", "[materials][band]") {
    std::vector<double> breaks;
    for (int i = 0; i < 60; ++i) breaks.push_back(1e4 / (3400.0 - 25.0 * i));
    const Band plain = flat_band("", 3.0, 5.0), cut = flat_band("", 3.0, 5.0, breaks);
    CHECK(band_radiance(plain, 300.0) == Approx(band_radiance(cut, 300.0)).epsilon(2e-8));
}

TEST_CASE("a triangular response weighs as its area and centre say", "[materials][band]") {
    const Band band = response_band("triangle", {{8.0, 10.0, 13.0}, {0.0, 1.0, 0.0}});
    CHECK(band.width_um() == Approx(2.5).epsilon(1e-13));
    CHECK(integrate(band, [](double um) { return um; }) / band.width_um() ==
          Approx((8.0 + 10.0 + 13.0) / 3.0).epsilon(1e-13));
}

TEST_CASE("bands are read from text, nonsense is refused", "[materials][band]") {
    CHECK(parse_band("3:5").name == "3-5");
    CHECK(parse_band("8-12").to_um() == 12.0);
    CHECK(parse_band("0.4:0.7").from_um() == 0.4);
    for (const char* text : {"", "3", "5:3", "3:3", "a:b", "3:5:7", "0:5", "3:1000", "nan:5",
                             "3,5:4", "-3:5", "3:inf"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_band(text), InputError);
    }
    CHECK_THROWS_AS(response_band("dark", {{3.0, 5.0}, {0.0, 0.0}}), InputError);
    CHECK_THROWS_AS(response_band("point", {{3.0}, {1.0}}), InputError);
}

namespace {

Spectrum response_of(const std::string& text) {
    const ScratchFolder folder("band");
    std::ofstream(folder.path / "response.csv") << text;
    return read_response(folder.path / "response.csv");
}

std::string refusal(const std::string& text) {
    try {
        response_of(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a response file is a band, in micrometres or nanometres", "[materials][band]") {
    const Spectrum um =
        response_of("# camera\nwavelength_um,response\n7,0\n7.5,0\n8,1\n12,1\n13,0\n14,0\n");
    CHECK(um.wavelength_um == std::vector<double>{7.5, 8.0, 12.0, 13.0});  // zeros cut off
    CHECK(response_band("lwir", um).width_um() == Approx(0.25 + 4.0 + 0.5).epsilon(1e-12));
    const Spectrum nm = response_of("wavelength_nm,response\n400,0.5\n700,1\n");
    CHECK(nm.wavelength_um[1] == Approx(0.7));
    // A flat response is the flat band: radiance of 8-12 µm at 300 K from the radiometry tables.
    const Spectrum flat = response_of("wavelength_um,response\n8,1\n12,1\n");
    CHECK(band_radiance(response_band("flat", flat), 300.0) == Approx(38.5004239333).epsilon(1e-7));
}

TEST_CASE("a response file's mistakes are reported with their place", "[materials][band]") {
    CHECK_THAT(refusal("um,response\n8,1\n12,1\n"), Catch::Contains("wavelength_um"));
    CHECK_THAT(refusal("wavelength_um,response\n8,1\n12,1.2\n"), Catch::Contains(":3:"));
    CHECK_THAT(refusal("wavelength_um,response\n8,1\n8,1\n"), Catch::Contains("ascending"));
    CHECK_THAT(refusal("wavelength_um,response\n400,1\n700,1\n"), Catch::Contains("wavelength_nm"));
    CHECK_THAT(refusal("wavelength_um,response\n8,0\n12,0\n"), Catch::Contains("zero everywhere"));
    CHECK_THAT(refusal("wavelength_um,response,x\n8,1,1\n12,1,1\n"), Catch::Contains("3 columns"));
    CHECK_THAT(refusal("wavelength_um,response\n8,one\n12,1\n"), Catch::Contains(":2:"));
}

TEST_CASE("the channels of a cube add up to its range", "[materials][band]") {
    const std::vector<Band> channels = channel_bands(3.0, 5.0, 40);
    REQUIRE(channels.size() == 40);
    double sum = 0.0;
    for (const Band& channel : channels) sum += band_radiance(channel, 300.0);
    CHECK(sum == Approx(1.86595620816).epsilon(1e-9));  // radiometry tables, 3-5 µm at 300 K
    CHECK(channels[0].name == "3.025um");
}
