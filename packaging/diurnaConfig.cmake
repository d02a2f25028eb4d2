# find_package(diurna): targets diurna::materials, ::terrain, ::thermal, ::render, ::scenes, each with
# all below it. Headers as in the sources: #include "terrain/place/site.hpp".
include(${CMAKE_CURRENT_LIST_DIR}/libraries.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/diurnaTargets.cmake)
