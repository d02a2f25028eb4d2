#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "scenes/job/plan/stage_id.hpp"

namespace diurna {

enum class ProgressStyle { bar, lines, json, silent };

/// A bar on a terminal, plain lines otherwise.
ProgressStyle default_progress_style();

/// Receives progress in addition to stderr: the stage and its share, 0 when it begins, 1 when it
/// ends, at most five times a second between. Called from any thread, one at a time.
using ProgressListener = std::function<void(const std::string& stage, double share)>;

/// Destinations of progress reports.
struct ProgressTo {
    ProgressStyle style = ProgressStyle::silent;
    ProgressListener listener{};  // empty: none

    ProgressTo() = default;
    ProgressTo(ProgressStyle on_stderr) : style(on_stderr) {}
    explicit ProgressTo(ProgressListener who) : listener(std::move(who)) {}
};

/// Reports the stages of a job and their progress, and records the seconds each stage took. If
/// not on a terminal (`lines`): a line when a stage ends; before that one for each tenth
/// completed, at least two seconds apart, and the current item after ten seconds without a
/// line.
class Progress {
 public:
    explicit Progress(ProgressTo to) : to_(std::move(to)) {}
    ~Progress();

    /// Ends the previous stage and begins the next.
    ///
    /// - what: what it works on, an observer or the step of a study; "": the whole scene
    void stage(StageId id, const std::string& what = "");
    /// Text before the names of the following stages: "solve 3 of 8"; "": none. stages() does not
    /// have it.
    void part(const std::string& text);
    /// Completed share of the present stage, 0 to 1. Fast; may be called from any thread.
    void done(double share);
    /// The current item of the present stage, in a few words; shown if it takes long.
    void doing(const std::string& what);
    /// Prints a separate line at once: information needed before the end.
    void tell(const std::string& note);
    /// Counts seconds of the present stage as a separate stage before it.
    void set_apart(StageId id, double seconds);
    /// Ends the last stage.
    void finish();

    struct Stage {
        StageId id;
        std::string name;  // name_of(id, what)
        double seconds;
    };
    const std::vector<Stage>& stages() const { return stages_; }

 private:
    using Clock = std::chrono::steady_clock;
    void show(double share, bool ended);
    bool due(double share) const;

    ProgressTo to_;
    std::mutex mutex_;
    StageId id_ = StageId::terrain;
    std::string name_, shown_name_, part_, doing_;
    double share_ = 0.0;  // last reported
    int tenths_ = 0;      // number already printed for the present stage
    Clock::time_point began_{}, shown_{}, heard_{};
    std::vector<Stage> stages_;
};

}  // namespace diurna
