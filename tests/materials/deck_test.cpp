#include "materials/modtran/deck.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/modtran/fortran_text.hpp"
#include "materials/modtran/run.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;
namespace fs = std::filesystem;
using Catch::Contains;

namespace {

const PrivateTempFolder private_temp_folder;

std::vector<std::string> lines(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> found;
    for (std::string line; std::getline(in, line);) found.push_back(line);
    return found;
}

double field(const std::string& line, std::size_t first, std::size_t width) {
    double value = -1e9;
    std::string text = first < line.size() ? line.substr(first, width) : "";
    text.erase(0, text.find_first_not_of(' '));
    while (text.ends_with(' ')) text.pop_back();
    CAPTURE(line, first);
    REQUIRE(parse_fortran(text, value));
    return value;
}

/// A program of one shell script, for want of MODTRAN.
ModtranRunner stub(const std::string& script, int milliseconds = 20000) {
    const fs::path file = fs::temp_directory_path() / "diurna_modtran_stub.sh";
    write_whole_file(file, "#!/bin/sh\n" + script);
    ::chmod(file.c_str(), 0755);
    return {.executable = file,
            .data = {},
            .time_limit = std::chrono::milliseconds(milliseconds),
            .output_limit = 4u << 20};
}

std::size_t folders_left() {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(fs::temp_directory_path())) {
        count += entry.path().filename().string().starts_with("diurna-modtran-");
    }
    return count;
}

}  // namespace

TEST_CASE("a tape5's fields are where MODTRAN 5 reads them", "[materials][modtran]") {
    const ModtranDeck deck{.emission = ModtranDeck::Emission::thermal,
                           .model = "TROP",
                           .aerosol = "rural",
                           .co2_ppm = 380.0,
                           .range_km = 5.0,
                           .first_per_cm = 2000.0,
                           .last_per_cm = 3333.333,
                           .step_per_cm = 10.0,
                           .width_per_cm = 20.0};
    const auto card = lines(write_tape5({deck}));
    REQUIRE(card.size() == 6);
    // FORMATS of the cards: 4A1,I1,11I5,1X,I4,F8.0,A7 and so on.
    CHECK(card[0].substr(0, 5) == "T F 1");
    CHECK(field(card[0], 5, 5) == 1);
    CHECK(field(card[0], 10, 5) == 1);
    CHECK(field(card[0], 15, 5) == 0);
    CHECK(field(card[1], 10, 10) == 380.0);
    CHECK(field(card[2], 2, 3) == 1);
    CHECK(field(card[2], 30, 10) == 23.0);
    CHECK(field(card[3], 30, 10) == 5.0);
    CHECK(field(card[4], 10, 10) == Approx(3333.333));
    CHECK(field(card[4], 30, 10) == 20.0);
    CHECK(card[5] == "    0");
    const auto folder = shared_data("data/atmosphere/tape7/tape5");
    if (!folder) return;
    // The same run as its authors wrote it: equal numbers in equal columns.
    const auto sample = lines(read_text(*folder / "tropical5km.tape5"));
    REQUIRE(sample.size() == card.size());
    for (std::size_t first = 5; first < 65; first += 5) {
        CHECK(field(card[0], first, 5) == field(sample[0], first, 5));
    }
    CHECK(field(card[1], 10, 10) == field(sample[1], 10, 10));
    CHECK(card[1].substr(40, 10) == sample[1].substr(40, 10));
    CHECK(field(card[3], 0, 10) == field(sample[3], 0, 10));
    CHECK(field(card[3], 30, 10) == field(sample[3], 30, 10));
    for (std::size_t first = 0; first < 40; first += 10) {
        CHECK(field(card[4], first, 10) == field(sample[4], first, 10));
    }
    CHECK(card[4].substr(40, 2) == sample[4].substr(40, 2));
}

TEST_CASE("a tape5 carries radiosonde, sun and several runs", "[materials][modtran]") {
    ModtranDeck deck{.emission = ModtranDeck::Emission::thermal_and_sun,
                     .multiple_scattering = true,
                     .model = "MLS",
                     .profile = afgl_profile("MLS"),
                     .path = ModtranDeck::PathType::to_space,
                     .zenith_deg = 60.0};
    deck.sun_azimuth_deg = 90.0;
    deck.sun_zenith_deg = 30.0;
    const auto card = lines(write_tape5({deck, {}}));
    CHECK(card[0].substr(4, 1) == "7");
    CHECK(field(card[0], 55, 5) == 1);  // I_RD2C: a profile follows
    const std::size_t levels = static_cast<std::size_t>(field(card[3], 0, 5));
    CHECK(levels == 46);
    CHECK(field(card[4], 10, 10) == Approx(1013.0));
    CHECK(field(card[4], 20, 10) == Approx(294.2));
    CHECK(card[4].substr(60, 14) == "AAA22222222222");
    const std::size_t path = 4 + levels;
    CHECK(field(card[path], 20, 10) == 60.0);
    CHECK(field(card[path + 2], 0, 10) == 90.0);
    CHECK(field(card[path + 2], 10, 10) == 30.0);
    CHECK(card[path + 4] == "    1");
    CHECK(card.back() == "    0");
}

TEST_CASE("a deck that makes no sense is not written", "[materials][modtran]") {
    const auto refused = [](ModtranDeck deck, const char* why) {
        CHECK_THROWS_WITH(write_tape5({deck}), Contains(why));
    };
    refused({.model = "MIDSUMMER"}, "model");
    refused({.aerosol = "rurl"}, "rural");
    refused({.visibility_km = -1}, "visibility");
    refused({.albedo = 1.5}, "albedo");
    refused({.h1_km = -3}, "h1_km");
    refused({.range_km = std::nan("")}, "range");
    refused({.first_per_cm = 900, .last_per_cm = 800}, "last_per_cm");
}

TEST_CASE("the program runs in its own folder and its result comes back",
          "[materials][modtran][run]") {
    const std::size_t before = folders_left();
    const std::string out =
        run_modtran(stub("pwd > tape7; cat tape5 >> tape7; env | sort >> tape7\n"),
                    "hello; $(touch /tmp/diurna_pwned)\n");
    CHECK_THAT(out, Contains("diurna-modtran-") && Contains("hello; $(touch") &&
                        Contains("LANG=C") && !Contains("HOME="));
    CHECK_FALSE(fs::exists("/tmp/diurna_pwned"));
    CHECK(folders_left() == before);
}

TEST_CASE("a program that hangs, floods, fails or writes nothing is reported",
          "[materials][modtran][run][stress]") {
    const std::size_t before = folders_left();
    const auto begin = std::chrono::steady_clock::now();
    const auto took = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    // Its child would write a file after two seconds if it lived on.
    const fs::path trace = fs::temp_directory_path() / "diurna_modtran_orphan";
    fs::remove(trace);
    CHECK_THROWS_WITH(
        run_modtran(stub("(sleep 2; touch " + trace.string() + ") & sleep 100\n", 300), ""),
        Contains("stopped after 0.3 s"));
    CHECK(took() < 5.0);
    CHECK_THROWS_WITH(run_modtran(stub("exec yes > tape7\n"), ""), Contains("more than"));
    CHECK_THROWS_WITH(run_modtran(stub("yes & sleep 100\n", 300), ""),
                      Contains("stopped after"));  // a flood of standard output goes nowhere
    CHECK_THROWS_WITH(run_modtran(stub("exit 3\n"), ""), Contains("code 3"));
    CHECK_THROWS_WITH(run_modtran(stub("kill -SEGV $$\n"), ""), Contains("signal 11"));
    CHECK_THROWS_WITH(run_modtran(stub("true\n"), ""), Contains("wrote no file"));
    CHECK_THROWS_WITH(run_modtran(stub("ln -s /etc/passwd tape7\n"), ""),
                      Contains("wrote no file"));
    CHECK(folders_left() == before);
    while (took() < 3.0) ::usleep(50000);
    CHECK_FALSE(fs::exists(trace));
}

TEST_CASE("the executable is named on the command line or in the environment",
          "[materials][modtran][run]") {
    ::unsetenv("DIURNA_MODTRAN");
    CHECK_FALSE(modtran_runner("").has_value());
    CHECK(modtran_runner("/bin/sh")->executable == "/bin/sh");
    CHECK_THROWS_WITH(modtran_runner("sh"), Contains("absolute"));
    CHECK_THROWS_WITH(modtran_runner("/etc/passwd"), Contains("executable"));
    ::setenv("DIURNA_MODTRAN", "/bin/sh", 1);
    CHECK(modtran_runner("")->executable == "/bin/sh");
    ::unsetenv("DIURNA_MODTRAN");
}
