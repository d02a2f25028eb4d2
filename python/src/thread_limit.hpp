#pragma once

namespace diurna::python {

/// The number of worker threads is one setting of the process, and changing it while a computation
/// runs is not safe. Every call that computes holds a RunningCall; the number changes only while
/// there is none.
class RunningCall {
 public:
    RunningCall();
    ~RunningCall();
    RunningCall(const RunningCall&) = delete;
    RunningCall& operator=(const RunningCall&) = delete;
};

/// The number for all later calls; 0: as many as the machine has cores. Throws InputError (key
/// "threads") for a negative number and while a call is running on another thread.
void set_threads(int threads);

/// Sets the number for one call. The number of set_threads() holds again once this is gone and no
/// call is running. Throws as set_threads() does.
class ThreadsOfCall {
 public:
    /// - threads: negative: no change
    explicit ThreadsOfCall(int threads);
    ~ThreadsOfCall();
    ThreadsOfCall(const ThreadsOfCall&) = delete;
    ThreadsOfCall& operator=(const ThreadsOfCall&) = delete;

 private:
    bool changed_;
};

}  // namespace diurna::python
