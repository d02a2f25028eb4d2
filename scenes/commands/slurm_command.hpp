#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna slurm`: scripts by which a cluster's nodes share a run. Throws InputError.
void add_slurm_verb(CLI::App& app);

}  // namespace diurna
