// Elevation files to networks of a stated tolerance: time, triangles, and the worst error found by
// rasterising the network again. Arguments: elevation files (default: the sample scene's).

#include "terrain/ground/tin_check.hpp"
#include "terrain/ground/triangulate.hpp"
#include "terrain/raster/read_dem.hpp"

#include <fmt/format.h>

#include <ctime>

using namespace diurna;

namespace {

/// The processor's own clock: other work on the machine does not count.
double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::filesystem::path> files(argv + 1, argv + argc);
    if (files.empty()) files.emplace_back(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    fmt::print("case,method,setting,facets,threads,cpu_s,error,unit\n");
    for (const auto& file : files) {
        const Dem dem = read_dem(file, {.voids = VoidPolicy::leave});
        for (const double tolerance : {10.0, 5.0, 2.0, 1.0, 0.5, 0.0}) {
            const double start = cpu_seconds();
            const Tin tin = triangulate(dem, tolerance);
            const double seconds = cpu_seconds() - start;
            fmt::print("{},greedy_tin,tolerance {} m,{},1,{:.3f},{:.3g},m\n", file.stem().string(),
                       tolerance, tin.triangle.size(), seconds, check_tin(dem, tin).worst_error);
        }
    }
}
