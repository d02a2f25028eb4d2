// Elevation files to networks of a stated tolerance: time, triangles, and the worst error found by
// rasterising the network anew. Arguments: elevation files (default: the sample scene's).

#include "terrain/triangulate.hpp"

#include <fmt/format.h>

#include <chrono>

using namespace diurna;

int main(int argc, char** argv) {
    std::vector<std::filesystem::path> files(argv + 1, argv + argc);
    if (files.empty()) files.emplace_back(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    fmt::print("case,method,setting,facets,threads,wall_s,error,unit\n");
    for (const auto& file : files) {
        const Dem dem = read_dem(file, {.voids = VoidPolicy::leave});
        for (const double tolerance : {10.0, 5.0, 2.0, 1.0, 0.5, 0.0}) {
            const auto start = std::chrono::steady_clock::now();
            const Tin tin = triangulate(dem, tolerance);
            const double seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            fmt::print("{},greedy_tin,tolerance {} m,{},1,{:.3f},{:.3g},m\n", file.stem().string(),
                       tolerance, tin.triangle.size(), seconds, check_tin(dem, tin).worst_error);
        }
    }
}
