#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/passed_over.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/scratch_folder.hpp"

// What cmake --install leaves, moved to another place: nothing of the sources is needed any more.
// packaging/smoke.sh does the same with Debian packages in a bare system.

namespace {

namespace fs = std::filesystem;

const fs::path build = fs::path(DIURNA_BINARY).parent_path();

/// Installed, then moved: no path written in at installing may matter.
void install(const fs::path& to) {
    const fs::path first = to.string() + ".first";
    for (const char* component : {"program", "development"}) {
        const Ran installed =
            ran(fmt::format("cmake --install '{}' --prefix '{}' --component {} 2>&1",
                            build.string(), first.string(), component));
        INFO(installed.out);
        REQUIRE(installed.code == 0);
    }
    fs::rename(first, to);
}

std::set<std::string> all(const std::string& text, const std::string& pattern) {
    const std::regex wanted(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), wanted), end; i != end; ++i)
        found.insert((*i)[1]);
    return found;
}

}  // namespace

TEST_CASE("an installed program finds its data and samples beside itself", "[package]") {
    const ScratchFolder scratch("installed");
    const fs::path place = scratch.path / "moved here";
    install(place);
    const std::string run =
        fmt::format("cd / && env -u DIURNA_DATA '{}/bin/diurna' ", place.string());

    const Ran doctor = ran(run + "doctor");
    CHECK(doctor.out.find((place / "share/diurna/materials").string() + " (found)") !=
          std::string::npos);
    for (const auto& sample : fs::directory_iterator(place / "share/diurna/scenes")) {
        if (sample.path().filename() == "bondville") continue;  // its weather is to be fetched
        INFO(sample.path());
        const Ran check =
            ran(run + fmt::format("check '{}' 2>&1", (sample.path() / "scene.toml").string()));
        INFO(check.out);
        CHECK(check.code == 0);  // those that name others' files beneath scenes/ too
    }

    SECTION("and the environment's, where it names one") {
        const Ran named =
            ran(fmt::format("DIURNA_DATA=/nowhere '{}/bin/diurna' doctor 2>&1", place.string()));
        CHECK(named.out.find("/nowhere") != std::string::npos);
        CHECK(named.out.find("missing") != std::string::npos);
    }
    SECTION("find_package(diurna) builds a stranger's program") {
        const fs::path consumer = fs::path(DIURNA_SOURCE_DIR) / "tests/packaging/consumer";
        const Ran built = ran(fmt::format(
            "cmake -S '{0}' -B '{1}' -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH='{2}' "
            "2>&1 && cmake --build '{1}' 2>&1",
            consumer.string(), (scratch.path / "consumer").string(), place.string()));
        INFO(built.out);
        REQUIRE(built.code == 0);
        // Its data are not beside it: the installed folder is named.
        const Ran consumed =
            ran(fmt::format("DIURNA_DATA='{0}/share/diurna/materials' '{1}' 2>&1", place.string(),
                            (scratch.path / "consumer/consumer").string()));
        INFO(consumed.out);
        CHECK(consumed.code == 0);
    }
}

TEST_CASE("the manual page has every verb and option of the program's help", "[package]") {
    const std::string program = "'" DIURNA_BINARY "' ";
    const std::string page = ran(program + "pages --man").out;
    std::string plain = std::regex_replace(page, std::regex("\\\\-"), "-");
    const std::set<std::string> verbs = all(plain, "\n\\.SS \"diurna ([a-z]+)");
    CHECK(verbs == all(ran(program + "--help").out, "\n  ([a-z]+)  "));
    CHECK(verbs.size() > 20);
    for (const std::string& verb : verbs) {
        INFO(verb);
        const std::size_t from = plain.find("\n.SS \"diurna " + verb),
                          to = plain.find("\n.S", from + 5);
        const std::string part = plain.substr(from, to - from);
        const std::set<std::string> reported =
            all(part, "\n\\.BI? \"(?:-h, )?(--[A-Za-z0-9-]+) ?\"");
        std::set<std::string> helped =
            all(ran(program + verb + " --help").out, "\n +(?:-h,)?(--[A-Za-z0-9-]+)");
        helped.erase("--help");
        CHECK(reported == helped);
    }
    if (ran("command -v man").code != 0) {
        pass_over("no man here to format the page");
        return;
    }
    const ScratchFolder scratch("man");
    std::ofstream(scratch.path / "diurna.1") << page;
    const Ran man = ran(fmt::format("man --warnings -l '{}' 2>&1 >/dev/null",
                                    (scratch.path / "diurna.1").string()));
    CHECK(man.out.empty());
}

TEST_CASE("bash completes verbs, options and their words", "[package]") {
    const ScratchFolder scratch("completion");
    std::ofstream(scratch.path / "completion") << ran("'" DIURNA_BINARY "' pages --bash").out;
    const auto completed = [&](const std::string& line) {  // the last word is the one to complete
        return ran(fmt::format(
                       "bash -c 'source \"{}\"; COMP_WORDS=({}); "
                       "COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _diurna; echo ${{COMPREPLY[*]}}'",
                       (scratch.path / "completion").string(), line))
            .out;
    };
    CHECK(completed("diurna cro") == "crossover\n");
    CHECK(completed("diurna c") == "check column contrast crossover calibrate\n");
    CHECK(completed("diurna run scene.toml --al") == "--allow-outside\n");
    CHECK(completed("diurna run scene.toml --progress j") == "json\n");
    CHECK(completed("diurna run sce") == "\n");  // a file: left to bash
}

TEST_CASE("the bill of materials names every library that is linked", "[package]") {
    const std::string bill = ran("'" DIURNA_BINARY "' pages --bill").out;
    // Parts of the file names that the loader knows, and the bill's names for them.
    const std::pair<const char*, const char*> linked[] = {{"libembree", "Embree"},
                                                          {"liberfa", "ERFA"},
                                                          {"libfftw", "FFTW"},
                                                          {"libfmt", "fmt"},
                                                          {"libgdal", "GDAL"},
                                                          {"libGeographicLib", "GeographicLib"},
                                                          {"libhdf5", "HDF5"},
                                                          {"libgmp", "GMP"},
                                                          {"libmpfr", "MPFR"},
                                                          {"libpng", "libpng"},
                                                          {"libnetcdf", "netCDF"},
                                                          {"libOpenEXR", "OpenEXR"},
                                                          {"libOpenMeshCore", "OpenMesh"},
                                                          {"libcrypto", "OpenSSL"},
                                                          {"libtbb", "TBB"},
                                                          {"libtiff", "TIFF"},
                                                          {"libtomlplusplus", "toml++"}};
    // Of the compiler and of OpenEXR.
    const std::set<std::string> others{"libstdc",  "libm",           "libgcc_s",
                                       "libc",     "libImath-3",     "libIlmThread-3",
                                       "libIex-3", "ld-linux-x86-64"};
    const std::string needed = ran("readelf -d '" DIURNA_BINARY "' | grep NEEDED").out;
    for (const std::string& library : all(needed, "\\[([^\\]]+)\\.so")) {
        INFO(library);
        const auto* found =
            std::find_if(std::begin(linked), std::end(linked),
                         [&](const auto& known) { return library.rfind(known.first, 0) == 0; });
        if (found == std::end(linked)) {
            const std::string stem = library.substr(0, library.find_first_of("+."));
            CHECK(std::any_of(others.begin(), others.end(),
                              [&](const std::string& other) { return stem.rfind(other, 0) == 0; }));
            continue;
        }
        CHECK(bill.find(fmt::format("\"name\": \"{}\"", found->second)) != std::string::npos);
    }
}
