#include "materials/radiation/spectrum.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"

using namespace diurna;

namespace {

/// A file that is gone at the end of its scope.
struct ScratchFile {
    std::filesystem::path path;
    explicit ScratchFile(const std::string& text)
        : path(std::filesystem::temp_directory_path() /
               ("diurna_spectrum_test_" + std::to_string(::getpid()) + ".csv")) {
        write_whole_file(path, text);
    }
    ~ScratchFile() { std::filesystem::remove(path); }
};

std::string complaint(const std::string& text) {
    const ScratchFile file(text);
    try {
        read_spectrum(file.path, 0.0, 1.0);
    } catch (const InputError& error) {
        const std::string what = error.what();
        return what.substr(what.find(".csv") + 4);
    }
    return "accepted";
}

}  // namespace

TEST_CASE("a spectrum is linear between its points and zero outside", "[materials][spectrum]") {
    const Spectrum s{{1.0, 2.0, 4.0}, {0.0, 1.0, 0.5}};
    CHECK(s.at(1.0) == 0.0);
    CHECK(s.at(1.25) == 0.25);
    CHECK(s.at(3.0) == 0.75);
    CHECK(s.at(4.0) == 0.5);
    CHECK(s.at(0.999) == 0.0);
    CHECK(s.at(4.001) == 0.0);
    CHECK(Spectrum{}.at(1.0) == 0.0);
}

TEST_CASE("the integral of a piecewise linear function is exact", "[materials][spectrum]") {
    const Spectrum s{{1.0, 2.0, 4.0}, {0.0, 1.0, 0.5}};
    CHECK(integral(s) == Approx(0.5 + 1.5).epsilon(1e-15));
    CHECK(integral(s, 1.5, 3.0) == Approx(0.375 + 0.875).epsilon(1e-15));
    CHECK(integral(s, 0.0, 10.0) == Approx(integral(s)).epsilon(1e-15));
    CHECK(integral(s, 3.0, 2.0) == 0.0);
    CHECK(integral(flat_spectrum(0.3, 2.0, 5.0)) == Approx(0.9).epsilon(1e-15));
}

TEST_CASE("the weighted mean integrates the product exactly", "[materials][spectrum]") {
    // s = x on [0, 1], weight = x on [0, 1]: mean = int x^2 / int x = 2/3.
    const Spectrum s{{0.0, 0.3, 1.0}, {0.0, 0.3, 1.0}};
    const Spectrum weight{{0.0, 0.6, 1.0}, {0.0, 0.6, 1.0}};
    CHECK(weighted_mean(s, weight) == Approx(2.0 / 3.0).epsilon(1e-14));
    // Only the common range [1, 2] counts: int_1^2 x^2 / int_1^2 x = (7/3) / (3/2).
    CHECK(weighted_mean({{1.0, 3.0}, {1.0, 3.0}}, {{0.0, 2.0}, {0.0, 2.0}}) ==
          Approx(14.0 / 9.0).epsilon(1e-14));
    CHECK(weighted_mean(flat_spectrum(0.4), weight) == Approx(0.4).epsilon(1e-14));
    CHECK(weighted_mean(s, {{5.0, 6.0}, {1.0, 1.0}}) == 0.0);
}

TEST_CASE("spectrum files are read, and refused with their line", "[materials][spectrum]") {
    const ScratchFile file("# a comment\nwavelength_um,reflectance\n0.4,0.1\n0.8,0.5\n");
    const Spectrum s = read_spectrum(file.path, 0.0, 1.0);
    CHECK(s.wavelength_um == std::vector{0.4, 0.8});
    CHECK(s.value == std::vector{0.1, 0.5});

    CHECK_THAT(complaint("wavelength_um,r\n0.4,0.1\n0.4,0.2\n"), Catch::StartsWith(":3:1: "));
    CHECK_THAT(complaint("wavelength_um,r\n0.4,0.1\n0.8,1.2\n"), Catch::StartsWith(":3:2: r"));
    CHECK_THAT(complaint("wavelength_um,r\n0.4,0.1\n0.8,nan\n"), Catch::StartsWith(":3:2: r"));
    CHECK_THAT(complaint("wavelength_um,r\n0.4,0.1\n0.8\n"), Catch::StartsWith(":3: "));
    CHECK_THAT(complaint("wavelength_nm,r\n0.4,0.1\n0.8,0.2\n"),
               Catch::Contains("did you mean 'wavelength_nm'?"));
    CHECK_THAT(complaint("wavelength_um,r\n0.4,0.1\n"), Catch::Contains("expected at least 2"));
    CHECK_THAT(complaint("wavelength_um,r,s\n1,0,0\n2,0,0\n"), Catch::Contains("3 columns"));
    CHECK_THROWS_AS(read_spectrum("no_such_file.csv"), InputError);
}
