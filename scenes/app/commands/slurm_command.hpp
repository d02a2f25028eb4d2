#pragma once

namespace CLI {
class App;
}

namespace diurna {

/// `diurna slurm`: scripts to distribute a run over a cluster's nodes. Throws InputError.
void add_slurm_verb(CLI::App& app);

}  // namespace diurna
