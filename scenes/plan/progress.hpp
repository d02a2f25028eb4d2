#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace diurna {

enum class ProgressStyle { bar, lines, json, silent };

/// A bar on a terminal, plain lines elsewhere.
ProgressStyle default_progress_style();

/// Who is reported of progress besides stderr: the stage and its share, 0 when it begins, 1 when it
/// ends, at most five times a second between. Called from any thread, never from two at a time.
using ProgressListener = std::function<void(const std::string& stage, double share)>;

/// Where progress is reported.
struct ProgressTo {
    ProgressStyle style = ProgressStyle::silent;
    ProgressListener listener{};  // empty: nobody

    ProgressTo() = default;
    ProgressTo(ProgressStyle on_stderr) : style(on_stderr) {}
    explicit ProgressTo(ProgressListener who) : listener(std::move(who)) {}
};

/// Tells what a job is doing and how far it is, and keeps the seconds each stage took. Elsewhere
/// than on a terminal (`lines`): a line when a stage ends; before that one for each tenth that is
/// done, where these are two seconds apart, and what it works on after ten seconds without another
/// line.
class Progress {
 public:
    explicit Progress(ProgressTo to) : to_(std::move(to)) {}
    ~Progress();

    /// Ends the stage before and begins the next.
    void stage(const std::string& name);
    /// Share of the present stage that is done, 0 to 1. Cheap; may be called from any thread.
    void done(double share);
    /// What the present stage works on, in a few words; shown while it takes long.
    void doing(const std::string& what);
    /// A line of its own, at once: what somebody should know before it is done.
    void tell(const std::string& note);
    /// Counts seconds of the present stage as a stage of their own, before it.
    void set_apart(const std::string& name, double seconds);
    /// Ends the last stage.
    void finish();

    struct Stage {
        std::string name;
        double seconds;
    };
    const std::vector<Stage>& stages() const { return stages_; }

 private:
    using Clock = std::chrono::steady_clock;
    void show(double share, bool ended);
    bool due(double share) const;

    ProgressTo to_;
    std::mutex mutex_;
    std::string name_, doing_;
    double share_ = 0.0;  // as reported last
    int tenths_ = 0;      // of the present stage that have been shown as lines
    Clock::time_point began_{}, shown_{}, heard_{};
    std::vector<Stage> stages_;
};

}  // namespace diurna
