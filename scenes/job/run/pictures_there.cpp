#include "scenes/job/run/pictures_there.hpp"

#include <string>
#include <utility>

#include "scenes/job/plan/frame_files.hpp"

namespace diurna {

PicturesThere pictures_there(const Prepared& prepared, const std::vector<ObserverInput>& chosen,
                             const Ledger& ledger) {
    std::size_t there = 0, all = 0;
    std::vector<ObserverInput> observers = prepared.scene.observers;
    std::vector<Sequence> sequences = prepared.sequences;
    for (std::size_t o = 0; o < chosen.size(); ++o) {
        ObserverInput& observer = observers[o];
        Sequence& sequence = sequences[o];
        observer.bands = chosen[o].bands;
        observer.cubes = chosen[o].cubes;
        observer.instruments = chosen[o].instruments;
        Sequence kept{.frame = {}, .pose = {}, .goes = sequence.goes};
        for (std::size_t i = 0; i < sequence.frame.size(); ++i) {
            const auto files =
                frame_files(observer, sequence.frame[i], prepared.scene.labels.format);
            if (files.empty() || !ledger.has(files)) continue;
            kept.frame.push_back(sequence.frame[i]);
            if (sequence.goes) kept.pose.push_back(sequence.pose[i]);
        }
        if (!sequence.goes) kept.pose = sequence.pose;
        there += kept.frame.size();
        all += sequence.frame.size();
        observer.frames = kept.frame;
        sequence = std::move(kept);
    }
    return {with_pictures(prepared, std::move(observers), std::move(sequences)), there, all};
}

}  // namespace diurna
