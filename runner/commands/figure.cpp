#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "runner/commands/command.h"
#include "runner/commands/figure_runs.h"
#include "runner/commands/window.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/flow_drawing.h"
#include "runner/present/frame_drawing.h"
#include "runner/present/quality_drawing.h"
#include "runner/present/table.h"
#include "runner/present/zone_drawing.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostDrives = 3, kMostFlows = 6, kMostZones = 6;  ///< panels; of zones: lines

struct FigureArguments {
  std::string kind;
  std::vector<std::string> runs;
  std::optional<double> depth;
  std::vector<double> times;
  std::string window, out, root = "results";
};

const std::map<std::string, present::FigureKind> kDriveKinds = {{"bed", present::FigureKind::bed},
                                                                {"forces", present::FigureKind::forces},
                                                                {"initial", present::FigureKind::initial},
                                                                {"stress", present::FigureKind::stress},
                                                                {"velocity", present::FigureKind::velocity}};
const std::map<std::string, present::FlowFigureKind> kFlowKinds = {{"mesh", present::FlowFigureKind::mesh},
                                                                   {"velocity", present::FlowFigureKind::velocity},
                                                                   {"flow", present::FlowFigureKind::velocity},
                                                                   {"pressure", present::FlowFigureKind::pressure},
                                                                   {"porosity", present::FlowFigureKind::porosity}};
const std::string kQuality = "quality";  ///< of a flow too
const std::string kZone = "zone";        ///< of a drive
constexpr const char* kOfFlows = "mesh, velocity, pressure, porosity and quality";
constexpr const char* kOfDrives = "initial, bed, forces, stress, velocity and zone";

bool is_of_drives(const std::string& kind) { return kDriveKinds.contains(kind) || kind == kZone; }

bool is_of_flows(const std::string& kind) { return kFlowKinds.contains(kind) || kind == kQuality; }

/// Whether a figure of this kind shows the fluid of the run: of a drive "velocity" is that of its grains.
bool shows_fluid(const AskedRun& run, const std::string& figure) {
  return is_flow(run) || (is_of_flows(figure) && !is_of_drives(figure));
}

/// Throws UsageError when a run is not of a kind that has this figure.
void check_kind(const AskedRun& run, const std::string& figure) {
  const std::string& kind = run.manifest.header.kind;
  if (kind == "bed") throw UsageError(fmt::format("{} is a bed: nothing is driven into it", run.id));
  if (is_flow(run) && !is_of_flows(figure)) {
    throw UsageError(fmt::format("{} is a flow: its figures are {}", run.id, kOfFlows));
  }
  if (kind == "drive" && shows_fluid(run, figure) && run.manifest.flow_frames == 0) {
    throw UsageError(fmt::format("{} is a dry drive: its figures are {}", run.id, kOfDrives));
  }
}

std::string draw_drives(const FigureArguments& arguments, const std::vector<AskedRun>& asked,
                        present::PictureFormat format, const std::optional<present::View>& view) {
  const auto kind = kDriveKinds.at(arguments.kind);
  AskedFrames frames{arguments.root, arguments.depth, {}};
  std::vector<present::FrameOfRun> runs;
  for (const AskedRun& run : asked)
    runs.push_back(kind == present::FigureKind::initial ? load_initial(run, frames) : load_drive(run, frames));
  return present::picture_of(usage_checked([&] { return present::frame_figure(kind, runs, view); }), format);
}

/// Also rows of numbers, without a format.
std::string draw_zone(const FigureArguments& arguments, const std::vector<AskedRun>& asked,
                      const std::optional<present::PictureFormat>& format, const std::optional<present::View>& view) {
  AskedFrames frames{arguments.root, arguments.depth, {}};
  std::vector<present::ZoneOfRun> runs;
  for (const AskedRun& run : asked) runs.push_back(load_zone(run, frames));
  const auto figure = usage_checked([&] { return present::zone_figure(runs, view); });
  return format ? present::picture_of(figure, *format)
                : present::text(present::zone_table(figure), present::Format::csv);
}

std::string draw_flows(const FigureArguments& arguments, const std::vector<AskedRun>& asked,
                       present::PictureFormat format, const std::optional<present::View>& view) {
  if (arguments.depth && !arguments.times.empty()) throw UsageError("--depth and --time: one of them chooses frames");
  AskedFrames frames{arguments.root, arguments.depth, arguments.times};
  std::vector<present::FlowOfRun> runs;
  for (const AskedRun& run : asked) is_flow(run) ? load_flow(run, frames, runs) : load_fluid(run, frames, runs);
  if (runs.size() > kMostFlows) throw UsageError(fmt::format("{} panels; at most {}", runs.size(), kMostFlows));
  if (arguments.kind == kQuality)
    return present::picture_of(usage_checked([&] { return present::quality_figure(runs, view); }), format);
  const auto kind = kFlowKinds.at(arguments.kind);
  return present::picture_of(usage_checked([&] { return present::flow_figure(kind, runs, view); }), format);
}

/// The bytes of the picture; of rows of numbers without a format.
std::string draw(const FigureArguments& arguments, const std::vector<AskedRun>& asked,
                 const std::optional<present::PictureFormat>& format, const std::optional<present::View>& view) {
  for (const AskedRun& run : asked) check_kind(run, arguments.kind);
  const auto of_fluid = [&](const AskedRun& run) { return shows_fluid(run, arguments.kind); };
  if (std::ranges::all_of(asked, of_fluid)) return draw_flows(arguments, asked, *format, view);
  if (std::ranges::any_of(asked, of_fluid)) {
    throw UsageError(fmt::format("{} and {}: a drive and a flow have no scale in common", asked[0].id, asked[1].id));
  }
  const std::size_t most = arguments.kind == kZone ? kMostZones : kMostDrives;
  if (asked.size() > most) throw UsageError(fmt::format("{} drives; at most {}", asked.size(), most));
  if (!arguments.times.empty())
    throw UsageError(fmt::format("--time: {} is a drive; its frames are chosen by --depth", asked[0].id));
  if (arguments.depth && arguments.kind == "initial") throw UsageError("--depth: initial is at d = 0");
  if (arguments.kind == kZone) return draw_zone(arguments, asked, format, view);
  return draw_drives(arguments, asked, *format, view);
}

int figure(const FigureArguments& arguments) {
  const fs::path out = arguments.out.empty() ? arguments.kind + ".svg" : arguments.out;
  const auto format = present::picture_format(out);
  if (!format && !(arguments.kind == kZone && out.extension() == ".csv")) {
    throw UsageError(fmt::format("{}: a picture's name ends in .svg or .png{}", out.string(),
                                 arguments.kind == kZone ? ", that of its numbers in .csv" : ""));
  }
  const auto view = view_of(arguments.window);

  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  std::vector<AskedRun> asked;
  for (const std::string& prefix : arguments.runs) {
    std::optional<AskedRun> run = find_run(catalogue, prefix);
    if (!run) {
      fmt::print(stderr, "no case has an id that begins with {}\n", prefix);
      return execute::kNothingMatched;
    }
    asked.push_back(std::move(*run));
  }
  const std::string bytes = draw(arguments, asked, format, view);
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
                   "Of a drive: initial, bed, forces, stress, velocity or zone; of a flow: mesh, velocity, pressure, "
                   "porosity or "
                   "quality; of a drive in a saturated bed all of them, the fluid's velocity as flow")
      ->required()
      ->type_name("")
      ->check([](const std::string& word) {
        return is_of_drives(word) || is_of_flows(word) ? std::string()
                                                       : "there is no figure \"" + word +
                                                             "\"; there are initial, bed, forces, stress, velocity, "
                                                             "zone, mesh, flow, pressure, porosity and quality";
      });
  command
      ->add_option("RUN", arguments.runs, "Case ids, or how they begin: up to three drives side by side, or some flows")
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
  command->add_option("-o,--out", arguments.out, "Picture to write, .svg or .png, of zone also .csv; default: KIND.svg")
      ->type_name("FILE");
  add_store_option(*command, arguments.root);
  command->footer(
      "Kinds, of a drive:\n"
      "  initial   grains, pile and fluid as they are at d = 0, with their sizes\n"
      "  bed       grains in two tones that change with the height at which they lay before the drive\n"
      "  forces    a line per contact, as wide as its normal force is large\n"
      "  stress    an ellipse per cell, its semi-axes the principal stresses, coloured by the major one\n"
      "  velocity  an arrow per grain, coloured by its speed over the largest speed of the pile\n"
      "  zone      porosity, vertical and major principal stress against the distance from the pile's axis, at d = 0 "
      "and\n"
      "            at --depth, and the distance at which the change fades below 5 % of its largest: means left and "
      "right\n"
      "            over the cells from 2 R below to 2 R above the tip, or of a --window, whose X are distances and "
      "whose Y\n"
      "            are heights; -o FILE.csv writes the numbers\n"
      "Without --window, initial and bed show the whole box; forces, stress and velocity show 1.2 m by 1.2 m, the tip "
      "at\n"
      "a third from the top.\n"
      "x is 0 in the middle of the box, y is 0 at its base. A frame has to have been asked for within 1 mm of "
      "--depth.\n"
      "\n"
      "Kinds, of a flow, and of a drive in a saturated bed at a --depth or at some --time:\n"
      "  mesh      the triangles' edges, the free surface and the rest of the boundary\n"
      "  velocity  colours of the speed, linear in each triangle, and arrows on a regular grid; of a drive: flow\n"
      "  pressure  colours of the pressure without the hydrostatic one\n"
      "  porosity  colours of the share of the plane that is outside grains\n"
      "  quality   meshes, and below each of them histograms of its triangles' shapes and smallest angles\n"
      "Without --window, a basin is seen as a whole, x being 0 in its middle and y at its bottom; a jet, always in "
      "its\n"
      "last frame, from 2 H before the lip to 4 H behind it, H being the die's radius or half gap, x being 0 at the\n"
      "lip and y on the axis.\n"
      "\n"
      "Examples:\n"
      "  runner figure forces 1a2b3c4d5e --depth 0.6 -o forces.svg\n"
      "  runner figure stress 1a2b3c4d5e 6f7a8b9c0d --depth 0.6 -o stress.png\n"
      "  runner figure bed 1a2b3c4d5e --window -1,1,0,2.2\n"
      "  runner figure zone 1a2b3c4d5e 6f7a8b9c0d --depth 0.6 -o zone.csv\n"
      "  runner figure mesh 9c4cddb476 --window -0.2,0.4,0.7,1.1 -o mesh.svg\n"
      "  runner figure mesh 5d0e62b1c7 --time 0,2.5,5\n"
      "  runner figure pressure 1a2b3c4d5e --depth 0.6\n"
      "  runner figure quality 5d0e62b1c7 83aa91f20e --time 5\n"
      "  runner figure velocity 9c4cddb476 212fdcfbb0 -o velocity.png");
  command->callback([&call] { call = [] { return figure(arguments); }; });
}

}  // namespace seapile::commands
