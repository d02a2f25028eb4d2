#include "terrain/relief/tile_march.hpp"

namespace diurna {

namespace {

MarchFunction* const march_posts =
    __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")
        ? march_avx512
        : march_avx2;

}  // namespace

void march_tiles(const HeightField& field, const GridWays& ways, int tile_row,
                 const HorizonRequest& request, std::span<float> tangent) {
    const MarchField heights = field.march_field();
    const int first_row = tile_row * tile_side;
    const int last_row = std::min(field.rows(), first_row + tile_side);
    GridWay room;
    for (int column = 0; column < field.columns(); column += tile_side) {
        const MarchPart part{.first_row = first_row,
                             .last_row = last_row,
                             .first_column = column,
                             .last_column = std::min(field.columns(), column + tile_side),
                             .lift = static_cast<float>(request.lift),
                             .start = request.start,
                             .stop = request.stop};
        march_posts(heights, ways.at(first_row, column, room).view(), part, tangent.data() + column,
                    field.columns());
    }
}

}  // namespace diurna
