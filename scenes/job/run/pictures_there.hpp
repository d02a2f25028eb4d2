#pragma once

#include <cstddef>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/ledger.hpp"

namespace diurna {

/// The scene with those of the chosen pictures that are in the folder, for labels and report.
struct PicturesThere {
    Prepared scene;
    std::size_t there, all;  // frames that are there, of those chosen
};
PicturesThere pictures_there(const Prepared& prepared, const std::vector<ObserverInput>& chosen,
                             const Ledger& ledger);

}  // namespace diurna
