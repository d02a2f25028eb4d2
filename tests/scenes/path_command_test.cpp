#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include "materials/base/files.hpp"
#include "materials/radiation/band.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/modtran_stub.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

struct Output {
    int code;
    std::string text;
};

Output run(const std::string& arguments) {
    FILE* const pipe =
        ::popen((std::string(DIURNA_BINARY) + " path " + arguments + " 2>&1").c_str(), "r");
    REQUIRE(pipe != nullptr);
    Output out{0, ""};
    char buffer[512];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) out.text += buffer;
    const int status = ::pclose(pipe);
    out.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return out;
}

/// The cell of a column of the first row below the headings.
double cell(const std::string& text, int column) {
    std::size_t at = text.find('\n') + 1;
    for (int i = 0; i < column; ++i) at = text.find(',', at) + 1;
    return std::stod(text.substr(at));
}

}  // namespace

TEST_CASE("path prints scattered sun when the sun's place is given", "[scenes][path]") {
    const std::string sky =
        "--profile MLS --aerosol rural --zenith-deg 30 --to-space --band 0.4:0.7";
    const Output without = run(sky), with = run(sky + " --sun-zenith-deg 40");
    REQUIRE(with.code == 0);
    CHECK(without.text.find("scattered") == std::string::npos);
    CHECK(with.text.find(",scattered_sun_W_m2_sr,contrast_transmittance\n") != std::string::npos);
    // A blue sky has some tens of W m-2 sr-1 in the visible: 0.01 to 0.1 of the sun's 500 W m-2.
    CHECK(cell(with.text, 3) > 5.0);
    CHECK(cell(with.text, 3) < 200.0);
    CHECK(cell(with.text, 1) == cell(without.text, 1));
    // Away from the sun it is darker.
    CHECK(cell(run(sky + " --sun-zenith-deg 40 --azimuth-from-sun-deg 180").text, 3) <
          0.6 * cell(with.text, 3));
    CHECK(cell(run(sky + " --sun-zenith-deg 130").text, 3) == 0.0);
}

TEST_CASE("path prints what is left of a small difference of temperature", "[scenes][path]") {
    // A kelvin more of a black body at 300 K behind the same air, bin by bin: in the spectrum's own
    // transmittances, weighted by Planck's slope.
    const ScratchFolder folder("path-contrast");
    const std::filesystem::path csv = folder.path / "spectrum.csv";
    const Output out =
        run("--profile MLS --aerosol rural --zenith-deg 90 --range-km 5 --band 8:12 "
            "--csv " +
            csv.string());
    REQUIRE(out.code == 0);
    std::istringstream lines(diurna::read_text(csv));
    std::string line;
    std::getline(lines, line);
    double left = 0.0, all = 0.0;
    while (std::getline(lines, line)) {
        double from = 0.0, to = 0.0, tau = 0.0;
        REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf", &from, &to, &tau) == 3);
        from = std::max(from, 8.0);
        to = std::min(to, 12.0);
        if (!(to > from)) continue;
        const double slope = (to - from) * diurna::planck_derivative(0.5 * (from + to), 300.0);
        left += slope * tau;
        all += slope;
    }
    CHECK(cell(out.text, 3) == Approx(left / all).epsilon(1e-3));
    CHECK(std::abs(cell(out.text, 3) / cell(out.text, 1) - 1.0) > 0.01);  // not the plain mean
}

TEST_CASE("path takes rain and a radiosonde's file", "[scenes][path]") {
    const std::string level = "--zenith-deg 90 --range-km 1 --band 8:12";
    CHECK(cell(run(level + " --rain-mm-h 25").text, 1) < 0.1 * cell(run(level).text, 1));
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / "diurna_path_command.csv";
    diurna::write_whole_file(file,
                             "height_m,pressure_hPa,temperature_C,relative_humidity_percent\n"
                             "0,1013,30,90\n2000,800,15,80\n8000,360,-30,20\n");
    const Output wet = run(level + " --profile " + file.string());
    CHECK(wet.code == 0);
    CHECK(cell(wet.text, 1) < cell(run(level + " --profile SAW").text, 1));
    CHECK(run(level + " --profile /nowhere.csv").code == 2);
    CHECK(run(level + " --rain-mm-h -1").code == 2);
}

TEST_CASE("MODTRAN named on the command line replaces the embedded model", "[scenes][path][run]") {
    const ScratchFolder folder("path-modtran");
    const std::filesystem::path stub = folder.path / "modtran";
    write_modtran_stub(stub);
    const std::string path =
        "--profile MLS --aerosol rural --zenith-deg 90 --range-km 5 --band 8:12 --band 3:5";
    const Output out = run(path + " --modtran " + stub.string());
    CAPTURE(out.text);
    REQUIRE(out.code == 0);
    CHECK(out.text.starts_with(
        "band_um,transmittance,thermal_path_radiance_W_m2_sr,contrast_transmittance\n8-12,"));
    // The stub's air: 0.1 per km at 300 K. It prints radiance to five digits every 5 cm-1.
    const double tau = std::exp(-0.5);
    CHECK(cell(out.text, 1) == Approx(tau).epsilon(1e-6));
    const diurna::Band band = diurna::flat_band("", 8.0, 12.0);
    CHECK(cell(out.text, 2) ==
          Approx((1.0 - tau) * diurna::band_radiance(band, 300.0)).epsilon(1e-4));
    CHECK(cell(out.text, 3) == Approx(tau).epsilon(1e-6));  // grey air: by whatever weight
    CHECK(run(path).text != out.text);

    const Output missing = run(path + " --modtran /no/such/modtran");
    CHECK(missing.code == 2);
    CHECK(missing.text.find("/no/such/modtran") != std::string::npos);
    CHECK(run(path + " --modtran modtran").code == 2);  // not absolute
    CHECK(run(path + " --csv x.csv --modtran " + stub.string()).code == 2);

    diurna::write_whole_file(stub, "#!/bin/sh\nexit 3\n");
    ::chmod(stub.c_str(), 0755);
    CHECK(run(path + " --modtran " + stub.string()).code == 1);
}
