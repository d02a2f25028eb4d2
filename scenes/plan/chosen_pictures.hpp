#pragma once

#include <string>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/plan/shard.hpp"

namespace diurna {

/// Which of a scene's pictures a run takes. Its world, its plan and its heat stay those of all of
/// them, so that every picture has the bytes that it has among the others.
struct PictureChoice {
    /// "observer=east", "band=8-12" (a cube's name, too), "frames=05:00..09:00",
    /// "frames=22:00..02:00", "frames=2026-07-15T06:00:00-04:00": hours of every day on the clock
    /// of time.start, or instants, ends included. Of one kind any will do, of several all must.
    std::vector<std::string> only{};
    Shard shard{};  // of what is left
    bool all() const { return only.empty() && shard.all(); }
};

/// The scene's observers, in its order, with the bands and frames that are chosen; without either
/// where none are. Throws InputError (of --only) for names and hours that the scene does not have,
/// where nothing is left, and where pictures would be parted from those that they depend on: a
/// bolometer's from the one before, adaptive samples from the other bands. A shard parts none of
/// these; it may have nothing.
std::vector<ObserverInput> chosen_pictures(const Scene& scene, const PictureChoice& choice);

}  // namespace diurna
