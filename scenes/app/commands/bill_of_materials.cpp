#include "scenes/app/commands/bill_of_materials.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace diurna {

namespace {

struct LibraryOrigin {
    const char* package;  // of Debian 12, to build with
    const char* licence;  // SPDX
};

/// Licences as the packages' copyright files state them.
const std::map<std::string, LibraryOrigin>& origins() {
    static const std::map<std::string, LibraryOrigin> all{
        {"Boost", {"libboost-dev", "BSL-1.0"}},
        {"CGAL", {"libcgal-dev", "GPL-3.0-or-later"}},
        {"CLI11", {"libcli11-dev", "BSD-3-Clause"}},
        {"Eigen", {"libeigen3-dev", "MPL-2.0"}},
        {"Embree", {"libembree-dev", "Apache-2.0"}},
        {"ERFA", {"liberfa-dev", "BSD-3-Clause"}},
        {"FFTW", {"libfftw3-dev", "GPL-2.0-or-later"}},
        {"fmt", {"libfmt-dev", "MIT"}},
        {"GDAL", {"libgdal-dev", "MIT"}},
        {"GeographicLib", {"libgeographiclib-dev", "MIT"}},
        {"GMP", {"libgmp-dev", "LGPL-3.0-or-later"}},
        {"HDF5", {"libhdf5-dev", "BSD-3-Clause"}},
        {"libpng", {"libpng-dev", "libpng-2.0"}},
        {"MPFR", {"libmpfr-dev", "LGPL-3.0-or-later"}},
        {"netCDF", {"libnetcdf-dev", "BSD-3-Clause"}},
        {"nlohmann-json", {"nlohmann-json3-dev", "MIT"}},
        {"OpenEXR", {"libopenexr-dev", "BSD-3-Clause"}},
        {"OpenMesh", {"libopenmesh-dev", "BSD-3-Clause"}},
        {"OpenSSL", {"libssl-dev", "Apache-2.0"}},
        {"TBB", {"libtbb-dev", "Apache-2.0"}},
        {"TIFF", {"libtiff-dev", "libtiff"}},
        {"toml++", {"libtomlplusplus-dev", "MIT"}},
    };
    return all;
}

}  // namespace

std::string bill_of_materials() {
    using OrderedJson = nlohmann::ordered_json;
    const auto licence = [](const char* id) {
        return OrderedJson::array({{{"license", {{"id", id}}}}});
    };
    OrderedJson components = OrderedJson::array();
    std::istringstream libraries(DIURNA_LIBRARIES);
    for (std::string library; std::getline(libraries >> std::ws, library, ',');) {
        const std::size_t gap = library.find(' ');
        const std::string name = library.substr(0, gap), version = library.substr(gap + 1);
        const auto origin = origins().find(name);
        if (origin == origins().end()) throw std::logic_error(name + ": of unknown origin");
        const std::string purl =
            std::string("pkg:deb/debian/") + origin->second.package + "?distro=bookworm";
        components.push_back({{"type", "library"},
                              {"name", name},
                              {"version", version},
                              {"licenses", licence(origin->second.licence)},
                              {"purl", purl}});
    }
    const OrderedJson program{{"type", "application"},
                              {"name", "diurna"},
                              {"version", DIURNA_VERSION},
                              {"licenses", licence("GPL-3.0-only")}};
    return OrderedJson{{"bomFormat", "CycloneDX"},
                       {"specVersion", "1.4"},
                       {"version", 1},
                       {"metadata", {{"component", program}}},
                       {"components", components}}
        .dump(2);
}

}  // namespace diurna
