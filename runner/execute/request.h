// What a worker is asked to do: one case. Handed over as JSON, so that a batch system can hand it over too.
#pragma once

#include <string>

#include "solver/scene/spec.h"

namespace seapile::execute {

struct Request {
  std::string root;          ///< of the store
  std::string kind;          ///< "bed", "drive" or "flow"
  std::string case_id;       ///< of the case to be run
  std::string canonical;     ///< its canonical text
  scene::SceneSpec scene;    ///< for a bed: the bed alone
  scene::RecordSpec record;  ///< what to record of a drive or a basin
  std::string bed_id;        ///< of a drive's bed; "" otherwise
  std::string bed_run;  ///< the bed's run to start from; "" otherwise, and for a drive whose bed is still to come: the
                        ///< newest one that is fresh when the worker begins
  std::string newest;   ///< newest sealed run of the case when it was planned; "": none
  int threads = 1;
  double checkpoint_every = 10;  ///< [s] of wall time between two checkpoints
  int parent = 0;                ///< process that the worker must not outlive; 0: none
};

std::string to_json(const Request& request);

/// Throws study::BadInput.
Request request_from_json(const std::string& text, const std::string& file);

/// Reads a request from a file, or from standard input when the name is "-". Throws study::BadInput.
Request read_request(const std::string& file);

}  // namespace seapile::execute
