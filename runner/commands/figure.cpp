#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "runner/commands/command.h"
#include "runner/commands/window.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/flow_drawing.h"
#include "runner/present/frame_drawing.h"
#include "runner/present/quality_drawing.h"
#include "runner/store/catalogue.h"
#include "runner/study/study.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

constexpr double kDepthTolerance = 1e-3;  ///< [m] between the depth that is asked for and that of a frame

constexpr std::size_t kMostDrives = 2, kMostFlows = 6;  ///< panels

struct FigureArguments {
  std::string kind;
  std::vector<std::string> runs;
  std::optional<double> depth;
  std::vector<double> times;
  std::string window, out, root = "results";
};

const std::map<std::string, present::FigureKind> kDriveKinds = {{"bed", present::FigureKind::bed},
                                                                {"forces", present::FigureKind::forces},
                                                                {"stress", present::FigureKind::stress},
                                                                {"velocity", present::FigureKind::velocity}};
const std::map<std::string, present::FlowFigureKind> kFlowKinds = {{"mesh", present::FlowFigureKind::mesh},
                                                                   {"velocity", present::FlowFigureKind::velocity},
                                                                   {"flow", present::FlowFigureKind::velocity},
                                                                   {"pressure", present::FlowFigureKind::pressure},
                                                                   {"porosity", present::FlowFigureKind::porosity}};
const std::string kQuality = "quality";  ///< of a flow too
constexpr const char* kOfFlows = "mesh, velocity, pressure, porosity and quality";
constexpr const char* kOfDrives = "bed, forces, stress and velocity";

bool is_of_flows(const std::string& kind) { return kFlowKinds.contains(kind) || kind == kQuality; }

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
  const auto bed = store::read_manifest(store::case_folder(root, header.bed_id) / header.bed_run);
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
    for (const auto& [path, value] : labels) words.push_back(path + "=" + value);
    return fmt::format("{}", fmt::join(words, ", "));
  }
  return "case " + id;
}

/// A run that was asked for.
struct Asked {
  fs::path folder;
  store::Manifest manifest;
  std::string id;     ///< shortened
  std::string title;  ///< what tells it from others
};

/// The run whose case's id begins so; absent when there is none.
std::optional<Asked> find(const store::Catalogue& catalogue, const std::string& prefix) {
  const fs::path folder = usage_checked([&] { return catalogue.find(prefix); });
  if (folder.empty()) return std::nullopt;
  store::Manifest manifest = store::read_manifest(folder);
  const std::string id = manifest.header.case_id.substr(0, 10);
  return Asked{folder, std::move(manifest), id, title_of(catalogue, folder, id)};
}

bool is_flow(const Asked& run) { return run.manifest.header.kind == "flow"; }

/// Whether a figure of this kind shows the fluid of the run: of a drive "velocity" is that of its grains.
bool shows_fluid(const Asked& run, const std::string& figure) {
  return is_flow(run) || (is_of_flows(figure) && !kDriveKinds.contains(figure));
}

/// Throws UsageError when a run is not of a kind that has this figure.
void check_kind(const Asked& run, const std::string& figure) {
  const std::string& kind = run.manifest.header.kind;
  if (kind == "bed") throw UsageError(fmt::format("{} is a bed: nothing is driven into it", run.id));
  if (is_flow(run) && !is_of_flows(figure)) {
    throw UsageError(fmt::format("{} is a flow: its figures are {}", run.id, kOfFlows));
  }
  if (kind == "drive" && shows_fluid(run, figure) && run.manifest.flow_frames == 0) {
    throw UsageError(fmt::format("{} is a dry drive: its figures are {}", run.id, kOfDrives));
  }
}

/// A run and its frame; without a depth, its last one, whose depth is then the one for the runs that follow.
present::FrameOfRun load_drive(const Asked& run, const fs::path& root, std::optional<double>& depth) {
  const std::vector<double> asked = store::asked_depths(run.folder);
  if (asked.empty()) throw UsageError(fmt::format("{} has no frames", run.id));
  if (!depth) depth = asked.back();
  return {run.title, study::scene_from_json(run.manifest.header.scene_json), surface_of_bed(root, run.manifest.header),
          store::read_frame(run.folder, frame_at(*depth, asked, run.id))};
}

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

/// A flow in the frames that are asked for, each a panel.
void load_flow(const Asked& run, const FigureArguments& arguments, std::vector<present::FlowOfRun>& panels) {
  const std::vector<double> times = store::flow_frame_times(run.folder);
  if (times.empty()) throw UsageError(fmt::format("{} has no frames", run.id));
  const scene::SceneSpec scene = study::scene_from_json(run.manifest.header.scene_json);
  if (scene.jet && !arguments.times.empty())
    throw UsageError(fmt::format("--time: {} is a jet; its last frame is drawn", run.id));
  if (arguments.depth) {
    throw UsageError(fmt::format("--depth: {} is a flow; {}", run.id,
                                 scene.jet ? "its last frame is drawn" : "its frames are chosen by --time"));
  }
  for (const std::size_t frame : frames_at(arguments.times, times, run.id))
    panels.push_back({run.title, scene, store::read_flow_frame(run.folder, frame)});
}

/// The fluid of a drive, at a depth or in the frames nearest to some times; without either its last frame, whose depth
/// is then the one for the runs that follow. The frames of grains and fluid belong together by their order.
void load_fluid(const Asked& run, const FigureArguments& arguments, std::optional<double>& depth,
                std::vector<present::FlowOfRun>& panels) {
  const std::vector<double> asked = store::asked_depths(run.folder), times = store::flow_frame_times(run.folder);
  if (asked.size() != times.size()) {
    throw store::StoreError(store::StoreError::Kind::damaged,
                            fmt::format("{}: {} frames of the grains and {} of the fluid, which belong together",
                                        run.folder.string(), asked.size(), times.size()));
  }
  std::vector<std::size_t> frames;
  if (arguments.times.empty()) {
    if (!depth) depth = asked.back();
    frames = {frame_at(*depth, asked, run.id)};
  } else {
    frames = frames_at(arguments.times, times, run.id);
  }
  const scene::SceneSpec scene = study::scene_from_json(run.manifest.header.scene_json);
  const double surface = surface_of_bed(arguments.root, run.manifest.header);
  for (const std::size_t frame : frames) {
    panels.push_back({run.title, scene, store::read_flow_frame(run.folder, frame),
                      present::PileInBed{surface, store::read_frame(run.folder, frame).depth}});
  }
}

std::string draw_drives(const FigureArguments& arguments, const std::vector<Asked>& asked,
                        present::PictureFormat format, const std::optional<present::View>& view) {
  if (!arguments.times.empty())
    throw UsageError(fmt::format("--time: {} is a drive; its frames are chosen by --depth", asked[0].id));
  std::vector<present::FrameOfRun> runs;
  std::optional<double> depth = arguments.depth;
  for (const Asked& run : asked) runs.push_back(load_drive(run, arguments.root, depth));
  const auto kind = kDriveKinds.at(arguments.kind);
  return present::picture_of(usage_checked([&] { return present::frame_figure(kind, runs, view); }), format);
}

std::string draw_flows(const FigureArguments& arguments, const std::vector<Asked>& asked, present::PictureFormat format,
                       const std::optional<present::View>& view) {
  if (arguments.depth && !arguments.times.empty()) throw UsageError("--depth and --time: one of them chooses frames");
  std::vector<present::FlowOfRun> runs;
  std::optional<double> depth = arguments.depth;
  for (const Asked& run : asked)
    is_flow(run) ? load_flow(run, arguments, runs) : load_fluid(run, arguments, depth, runs);
  if (runs.size() > kMostFlows) throw UsageError(fmt::format("{} panels; at most {}", runs.size(), kMostFlows));
  if (arguments.kind != kQuality) {
    const auto kind = kFlowKinds.at(arguments.kind);
    return present::picture_of(usage_checked([&] { return present::flow_figure(kind, runs, view); }), format);
  }
  if (view) throw UsageError("--window: quality is of whole meshes");
  return present::picture_of(present::quality_figure(runs), format);
}

/// The bytes of the picture.
std::string draw(const FigureArguments& arguments, const std::vector<Asked>& asked, present::PictureFormat format,
                 const std::optional<present::View>& view) {
  for (const Asked& run : asked) check_kind(run, arguments.kind);
  const auto of_fluid = [&](const Asked& run) { return shows_fluid(run, arguments.kind); };
  if (std::ranges::all_of(asked, of_fluid)) return draw_flows(arguments, asked, format, view);
  if (std::ranges::any_of(asked, of_fluid)) {
    throw UsageError(fmt::format("{} and {}: a drive and a flow have no scale in common", asked[0].id, asked[1].id));
  }
  if (asked.size() > kMostDrives) throw UsageError(fmt::format("{} drives; at most {}", asked.size(), kMostDrives));
  return draw_drives(arguments, asked, format, view);
}

int figure(const FigureArguments& arguments) {
  const fs::path out = arguments.out.empty() ? arguments.kind + ".svg" : arguments.out;
  const auto format = present::picture_format(out);
  if (!format) throw UsageError(fmt::format("{}: a picture's name ends in .svg or .png", out.string()));
  const auto view = view_of(arguments.window);

  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  std::vector<Asked> asked;
  for (const std::string& prefix : arguments.runs) {
    std::optional<Asked> run = find(catalogue, prefix);
    if (!run) {
      fmt::print(stderr, "no case has an id that begins with {}\n", prefix);
      return execute::kNothingMatched;
    }
    asked.push_back(std::move(*run));
  }
  const std::string bytes = draw(arguments, asked, *format, view);
  try {
    store::write_text(out, bytes);
  } catch (const store::StoreError& error) {
    throw UsageError(error.what());
  }
  fmt::print("{}\n", out.string());
  return execute::kDone;
}

}  // namespace

void add_figure(CLI::App& app, Call& call) {
  static FigureArguments arguments;
  CLI::App* command = app.add_subcommand("figure", "Draw frames of drives or of flows, on scales in common");
  command
      ->add_option("KIND", arguments.kind,
                   "Of a drive: bed, forces, stress or velocity; of a flow: mesh, velocity, pressure, porosity or "
                   "quality; of a drive in a saturated bed all of them, the fluid's velocity as flow")
      ->required()
      ->type_name("")
      ->check([](const std::string& word) {
        return kDriveKinds.contains(word) || is_of_flows(word)
                   ? std::string()
                   : "there is no figure \"" + word +
                         "\"; there are bed, forces, stress, velocity, mesh, flow, pressure, porosity and quality";
      });
  command->add_option("RUN", arguments.runs, "Case ids, or how they begin: one or two drives, or some flows")
      ->required()
      ->type_name("");
  command->add_option("--depth", arguments.depth, "Depth d of the tip [m]; default: the last frame of the first run");
  command
      ->add_option(
          "--time", arguments.times,
          "Of a fluid that is no jet: the frame nearest to this time [s]; several times are several panels; default: "
          "the last")
      ->type_name("T,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--window", arguments.window, "What is seen [m]; of a jet [H]; default: see below")
      ->type_name("X0,X1,Y0,Y1");
  command->add_option("-o,--out", arguments.out, "Picture to write, .svg or .png; default: KIND.svg")
      ->type_name("FILE");
  add_store_option(*command, arguments.root);
  command->footer(
      "Kinds, of a drive:\n"
      "  bed       grains in two tones that change with the height at which they lay before the drive\n"
      "  forces    a line per contact, as wide as its normal force is large\n"
      "  stress    an ellipse per cell, its semi-axes the principal stresses, coloured by the major one\n"
      "  velocity  an arrow per grain, coloured by its speed over the largest speed of the pile\n"
      "Without --window, bed shows the whole box; the others show 1.2 m by 1.2 m, the tip at a third from the top.\n"
      "x is 0 in the middle of the box, y is 0 at its base. A frame has to have been asked for within 1 mm of "
      "--depth.\n"
      "\n"
      "Kinds, of a flow, and of a drive in a saturated bed at a --depth or at some --time:\n"
      "  mesh      the triangles' edges, the free surface and the rest of the boundary\n"
      "  velocity  colours of the speed, linear in each triangle, and arrows on a regular grid; of a drive: flow\n"
      "  pressure  colours of the pressure without the hydrostatic one\n"
      "  porosity  colours of the share of the plane that is outside grains\n"
      "  quality   histograms of the triangles' shapes and smallest angles, a column per mesh\n"
      "Without --window, a basin is seen as a whole, x being 0 in its middle and y at its bottom; a jet, always in "
      "its\n"
      "last frame, from 2 H before the lip to 4 H behind it, H being the die's radius or half gap, x being 0 at the\n"
      "lip and y on the axis.\n"
      "\n"
      "Examples:\n"
      "  runner figure forces 1a2b3c4d5e --depth 0.6 -o forces.svg\n"
      "  runner figure stress 1a2b3c4d5e 6f7a8b9c0d --depth 0.6 -o stress.png\n"
      "  runner figure bed 1a2b3c4d5e --window -1,1,0,2.2\n"
      "  runner figure mesh 9c4cddb476 --window -0.2,0.4,0.7,1.1 -o mesh.svg\n"
      "  runner figure mesh 5d0e62b1c7 --time 0,2.5,5\n"
      "  runner figure pressure 1a2b3c4d5e --depth 0.6\n"
      "  runner figure quality 5d0e62b1c7 83aa91f20e --time 5\n"
      "  runner figure velocity 9c4cddb476 212fdcfbb0 -o velocity.png");
  command->callback([&call] { call = [] { return figure(arguments); }; });
}

}  // namespace seapile::commands
