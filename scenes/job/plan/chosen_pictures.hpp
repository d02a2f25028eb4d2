#pragma once

#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/shard.hpp"

namespace diurna {

/// Selection of a scene's pictures for a run. World, plan and heat stay those of the whole scene,
/// so that every picture is the same as in a complete run.
struct PictureChoice {
    /// "observer=east", "band=8-12" (also a cube), "frames=05:00..09:00", "frames=22:00..02:00",
    /// "frames=2026-07-15T06:00:00-04:00": hours of every day on the clock of time.start, or
    /// instants, ends included. Of one kind any condition suffices; of several kinds all are
    /// needed.
    std::vector<std::string> only{};
    Shard shard{};  // of the remaining pictures
    bool all() const { return only.empty() && shard.all(); }
};

/// As the command line says it: "band=8-12", "shard 2/4".
std::vector<std::string> in_words(const PictureChoice& choice);

/// The scene's observers, in its order, with their selected bands and frames; observers with none
/// are left without either. Throws InputError (of --only) for names and hours that the scene does
/// not have, if nothing is left, and if pictures would be separated from those that they depend on:
/// a bolometer's from the previous one, adaptive samples from the other bands. A shard never
/// separates these; it may be empty.
std::vector<ObserverInput> chosen_pictures(const Scene& scene, const PictureChoice& choice);

}  // namespace diurna
