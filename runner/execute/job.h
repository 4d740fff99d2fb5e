// What a worker does: one case, from the request to the sealed run.
#pragma once

#include <functional>

#include "runner/execute/message.h"
#include "runner/execute/request.h"

namespace seapile::execute {

/// Binds this process to its runner: it dies with it, so that nothing works on unseen. Call it first thing.
/// False when the runner is gone already.
bool die_with(int parent);

/// SIGTERM, SIGINT and SIGUSR1 (batch systems) stop the case at a checkpoint from now on.
void listen_for_stop();

/// Runs the case under its claim, after deciding once more whether there is anything to do. Sends messages on the way.
/// Returns a worker's exit code; a code above zero other than kStoppedResumable goes with a Trouble message.
int work(const Request& request, const std::function<void(const Message&)>& tell);

}  // namespace seapile::execute
