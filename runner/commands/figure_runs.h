// What `figure` draws: the runs that were asked for, and their frames by depth or by time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runner/present/flow_figure.h"
#include "runner/present/frame_figure.h"
#include "runner/present/zone_figure.h"
#include "runner/store/catalogue.h"
#include "runner/store/run_folder.h"

namespace seapile::commands {

/// A run that was asked for.
struct AskedRun {
  std::filesystem::path folder;
  store::Manifest manifest;
  std::string id;     ///< shortened
  std::string title;  ///< what tells it from others
};

/// The run whose case's id begins so; absent when there is none. Throws UsageError when there are several.
std::optional<AskedRun> find_run(const store::Catalogue& catalogue, const std::string& prefix);

bool is_flow(const AskedRun& run);

/// Which frames: at a depth [m], or nearest to times [s]; with neither the last one.
struct AskedFrames {
  std::filesystem::path root;  ///< of the store, in which the beds are
  std::optional<double> depth;
  std::vector<double> times;
};

// All of them throw UsageError, in a sentence, when there is no such frame, and store::StoreError.

/// A drive's grains. Without a depth its last frame, whose depth is then the one for the runs that follow.
present::FrameOfRun load_drive(const AskedRun& run, AskedFrames& frames);

/// A drive's grains at d = 0, with its fluid when it has one.
present::FrameOfRun load_initial(const AskedRun& run, const AskedFrames& frames);

/// A drive's frames at d = 0 and at the depth; without one as load_drive().
present::ZoneOfRun load_zone(const AskedRun& run, AskedFrames& frames);

/// Adds a flow in the frames that are asked for, each a panel.
void load_flow(const AskedRun& run, const AskedFrames& frames, std::vector<present::FlowOfRun>& panels);

/// Adds the fluid of a drive in the frames that are asked for; without depth and times as load_drive().
void load_fluid(const AskedRun& run, AskedFrames& frames, std::vector<present::FlowOfRun>& panels);

}  // namespace seapile::commands
