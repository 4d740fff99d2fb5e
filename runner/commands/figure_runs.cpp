#include "runner/commands/figure_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runner/commands/command.h"
#include "runner/store/label_text.h"
#include "runner/study/study.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

constexpr double kDepthTolerance = 1e-3;  ///< [m] between the depth that is asked for and that of a frame

/// The frame of a run that was asked for at a depth.
std::size_t frame_at(double depth, const std::vector<double>& asked, const std::string& id) {
  const auto distance = [&](double other) { return std::abs(other - depth); };
  const auto nearest = std::ranges::min_element(asked, {}, distance);
  if (!(distance(*nearest) <= kDepthTolerance)) {  // so that no depth is near to "not a number"
    throw UsageError(fmt::format("{} has no frame within 1 mm of {:g} m; its frames are at {:g} m", id, depth,
                                 fmt::join(asked, ", ")));
  }
  return static_cast<std::size_t>(nearest - asked.begin());
}

double surface_of_bed(const fs::path& root, const store::RunHeader& header) {
  const auto bed = store::read_manifest(store::bed_run_folder(root, header));
  const auto& metrics = bed.result.metrics;
  const auto found = std::ranges::find(metrics, "surface", &simulation::Metric::name);
  if (found == metrics.end()) {
    throw store::StoreError(store::StoreError::Kind::damaged,
                            fmt::format("the bed {} does not say where its surface is", header.bed_id));
  }
  return found->value;
}

std::string title_of(const store::Catalogue& catalogue, const fs::path& folder, const std::string& id) {
  for (const auto& [other, labels] : catalogue.runs("", {})) {
    if (other != folder || labels.empty()) continue;
    std::vector<std::string> words;
    for (const auto& [path, value] : labels) words.push_back(store::label_text(path, value));
    return fmt::format("{}", fmt::join(words, ", "));
  }
  return "case " + id;
}

std::vector<double> depths_of(const AskedRun& run) {
  std::vector<double> depths = store::asked_depths(run.folder);
  if (depths.empty()) throw UsageError(fmt::format("{} has no frames", run.id));
  return depths;
}

scene::SceneSpec scene_of(const AskedRun& run) { return study::scene_from_json(run.manifest.header.scene_json); }

/// The frame of the fluid that is nearest to each of the times; without a time its last one.
std::vector<std::size_t> frames_at(const std::vector<double>& asked, const std::vector<double>& times,
                                   const std::string& id) {
  std::vector<std::size_t> frames;
  for (const double time : asked) {
    const auto distance = [&](double other) { return std::abs(other - time); };
    const auto nearest = static_cast<std::size_t>(std::ranges::min_element(times, {}, distance) - times.begin());
    if (std::ranges::find(frames, nearest) != frames.end()) {
      throw UsageError(
          fmt::format("--time: the frame of {} at {:g} s is the nearest one twice; its frames are at {:g} s", id,
                      times[nearest], fmt::join(times, ", ")));
    }
    frames.push_back(nearest);
  }
  if (frames.empty()) frames.push_back(times.size() - 1);
  return frames;
}

/// Frames of grains and fluid belong together by their order. Throws when they cannot.
void check_pairs(const AskedRun& run, std::size_t depths, std::size_t times) {
  if (depths == times) return;
  throw store::StoreError(store::StoreError::Kind::damaged,
                          fmt::format("{}: {} frames of the grains and {} of the fluid, which belong together",
                                      run.folder.string(), depths, times));
}

}  // namespace

std::optional<AskedRun> find_run(const store::Catalogue& catalogue, const std::string& prefix) {
  const fs::path folder = usage_checked([&] { return catalogue.find(prefix); });
  if (folder.empty()) return std::nullopt;
  store::Manifest manifest = store::read_manifest(folder);
  const std::string id = manifest.header.case_id.substr(0, 10);
  return AskedRun{folder, std::move(manifest), id, title_of(catalogue, folder, id)};
}

bool is_flow(const AskedRun& run) { return run.manifest.header.kind == "flow"; }

present::FrameOfRun load_drive(const AskedRun& run, AskedFrames& frames) {
  const std::vector<double> depths = depths_of(run);
  if (!frames.depth) frames.depth = depths.back();
  return {run.title,
          scene_of(run),
          surface_of_bed(frames.root, run.manifest.header),
          store::read_frame(run.folder, frame_at(*frames.depth, depths, run.id)),
          {}};
}

present::FrameOfRun load_initial(const AskedRun& run, const AskedFrames& frames) {
  AskedFrames start{frames.root, 0.0, {}};
  present::FrameOfRun loaded = load_drive(run, start);
  if (run.manifest.flow_frames == 0) return loaded;
  const std::vector<double> depths = depths_of(run);
  check_pairs(run, depths.size(), store::flow_frame_count(run.folder));
  loaded.fluid = store::read_flow_frame(run.folder, frame_at(0, depths, run.id));
  return loaded;
}

present::ZoneOfRun load_zone(const AskedRun& run, AskedFrames& frames) {
  AskedFrames start{frames.root, 0.0, {}};
  present::FrameOfRun before = load_drive(run, start), after = load_drive(run, frames);
  if (after.frame.asked == before.frame.asked)
    throw UsageError(fmt::format("zone compares a depth with d = 0; the frames of {} are at {:g} m", run.id,
                                 fmt::join(depths_of(run), ", ")));
  return {run.title, std::move(after.scene), after.surface, std::move(before.frame), std::move(after.frame)};
}

void load_flow(const AskedRun& run, const AskedFrames& frames, std::vector<present::FlowOfRun>& panels) {
  const std::vector<double> times = store::flow_frame_times(run.folder);
  if (times.empty()) throw UsageError(fmt::format("{} has no frames", run.id));
  const scene::SceneSpec scene = scene_of(run);
  if (scene.jet && !frames.times.empty())
    throw UsageError(fmt::format("--time: {} is a jet; its last frame is drawn", run.id));
  if (frames.depth) {
    throw UsageError(fmt::format("--depth: {} is a flow; {}", run.id,
                                 scene.jet ? "its last frame is drawn" : "its frames are chosen by --time"));
  }
  for (const std::size_t frame : frames_at(frames.times, times, run.id))
    panels.push_back({run.title, scene, store::read_flow_frame(run.folder, frame)});
}

void load_fluid(const AskedRun& run, AskedFrames& frames, std::vector<present::FlowOfRun>& panels) {
  const std::vector<double> depths = depths_of(run), times = store::flow_frame_times(run.folder);
  check_pairs(run, depths.size(), times.size());
  std::vector<std::size_t> chosen;
  if (frames.times.empty()) {
    if (!frames.depth) frames.depth = depths.back();
    chosen = {frame_at(*frames.depth, depths, run.id)};
  } else {
    chosen = frames_at(frames.times, times, run.id);
  }
  const scene::SceneSpec scene = scene_of(run);
  const double surface = surface_of_bed(frames.root, run.manifest.header);
  for (const std::size_t frame : chosen) {
    panels.push_back({run.title, scene, store::read_flow_frame(run.folder, frame),
                      present::PileInBed{surface, store::read_frame(run.folder, frame).depth}});
  }
}

}  // namespace seapile::commands
