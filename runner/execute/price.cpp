#include "runner/execute/price.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "runner/store/catalogue.h"
#include "runner/store/database.h"

namespace seapile::execute {
namespace {

/// The latest of runs like a case that its price goes by.
constexpr std::size_t kMostRuns = 20;
constexpr double kLargestFactor = 10;

/// Parameters that change what comes out of a step, and how many steps there are, but not how a step is computed.
constexpr std::array<std::string_view, 20> kNoWay = {"bed.seed",
                                                     "bed.file",
                                                     "bed.grains.",
                                                     "bed.domain.",
                                                     "pile.",
                                                     "fluid.density",
                                                     "fluid.depth",
                                                     "fluid.kinematic_viscosity",
                                                     "fluid.rate",
                                                     "fluid.surface.tension",
                                                     "jet.reynolds",
                                                     "jet.capillary",
                                                     "basin.gravity",
                                                     "basin.density",
                                                     "basin.viscosity",
                                                     "basin.surface.tension",
                                                     "basin.surface.initial",
                                                     "basin.time.duration",
                                                     "basin.pile.driving",
                                                     "basin.pile.tip"};

/// How a case is computed, and how much of it there is.
struct Work {
  std::string way;
  double grains = 1, duration = 1;
};

bool has_no_say(const std::string& path, const std::string& kind) {
  if (kind == "drive" && path.starts_with("bed.preparation.")) return true;  // its bed's, and paid for there
  return std::ranges::any_of(kNoWay, [&](std::string_view beginning) { return path.starts_with(beginning); });
}

Work work_of(const std::string& kind, const std::vector<store::Parameter>& parameters) {
  Work work;
  double depth = 0, speed = 0, ends = std::numeric_limits<double>::infinity();
  std::vector<std::string> way;
  for (const store::Parameter& parameter : parameters) {
    const auto is = [&](std::string_view path) { return parameter.path == path && parameter.number; };
    if (is("bed.grains.count") && kind != "flow") work.grains = *parameter.number;
    if (is("pile.depth")) depth = *parameter.number;
    if (is("pile.duration") || is("basin.time.duration")) ends = *parameter.number;
    if (is("pile.driving.constant.speed") || is("pile.driving.vibratory.speed")) speed = *parameter.number;
    if (has_no_say(parameter.path, kind)) continue;
    way.push_back(parameter.path + "=" +
                  (parameter.number ? fmt::format("{}", *parameter.number) : parameter.text.value_or("null")));
  }
  if (kind != "bed") {
    if (depth > 0 && speed > 0) ends = std::min(ends, depth / speed);
    if (std::isfinite(ends)) work.duration = ends;
  }
  std::ranges::sort(way);
  work.way = kind;
  for (const std::string& word : way) work.way += "\n" + word;
  return work;
}

std::vector<store::PastCost> history_of(const std::filesystem::path& root) {
  if (!std::filesystem::exists(root / store::kCatalogueFile)) return {};
  return store::Catalogue::open_read_only(root).costs();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

PriceList::PriceList(const std::vector<store::PastCost>& history) {
  for (const store::PastCost& cost : history) {
    const Work work = work_of(cost.kind, cost.parameters);
    std::vector<Cost>& costs = alike_[work.way][{work.grains, work.duration}];
    if (costs.size() < kMostRuns) costs.push_back({cost.cpu_seconds, cost.peak_memory_mb, cost.bytes});
  }
}

std::optional<Price> PriceList::price(const std::string& kind, const scene::SceneSpec& scene) const {
  const Work work = work_of(kind, store::parameters(study::to_json(scene), kind));
  const auto found = alike_.find(work.way);
  if (found == alike_.end()) return {};
  const auto away = [&](const auto& amount_and_costs) {
    const auto& [grains, duration] = amount_and_costs.first;
    return std::abs(std::log(work.grains / grains)) + std::abs(std::log(work.duration / duration));
  };
  const auto nearest = std::ranges::min_element(found->second, {}, away);
  if (away(*nearest) > std::log(kLargestFactor)) return {};

  const double grains = work.grains / nearest->first.first, duration = work.duration / nearest->first.second;
  Price price;
  std::vector<double> cpu, bytes;
  for (const Cost& cost : nearest->second) {
    cpu.push_back(cost.cpu_seconds * grains * duration);
    bytes.push_back(cost.bytes * grains);
    price.memory_mb = std::max(price.memory_mb, cost.memory_mb * std::max(1.0, grains));
  }
  price.cpu_seconds = median(cpu);
  price.bytes = median(bytes);
  price.runs = cpu.size();
  price.scaled = grains != 1 || duration != 1;
  return price;
}

Prices prices_of(const study::Study& study, const Plan& plan, const std::filesystem::path& root) {
  Prices prices(plan.tasks.size());
  const auto is_fresh = [](const Task& task) { return task.decision.action == Action::fresh; };
  if (std::ranges::all_of(plan.tasks, is_fresh)) return prices;
  const PriceList list(history_of(root));
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const Task& task = plan.tasks[i];
    if (is_fresh(task)) continue;
    const scene::SceneSpec& scene = study.cases[task.study_case].scene;
    prices[i] = list.price(name(task.kind), task.kind == Kind::bed ? bed_alone(scene) : scene);
  }
  return prices;
}

std::optional<double> typical_cpu_seconds(const Plan& plan, const Prices& prices, Kind kind) {
  std::vector<double> cpu;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    if (plan.tasks[i].kind == kind && prices[i]) cpu.push_back(prices[i]->cpu_seconds);
  }
  if (cpu.empty()) return {};
  return median(std::move(cpu));
}

Estimate estimate(const Plan& plan, const Prices& prices, int cores) {
  Estimate whole;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const Task& task = plan.tasks[i];
    if (task.decision.action == Action::fresh) continue;
    ++whole.to_run;
    if (!prices[i]) {
      ++whole.unpriced;
      continue;
    }
    whole.cpu_seconds += prices[i]->cpu_seconds;
    whole.bytes += prices[i]->bytes;
    whole.largest_mb = std::max(whole.largest_mb, prices[i]->memory_mb);
    double chain = prices[i]->cpu_seconds / std::min(task.most_threads, cores);
    if (task.bed && prices[*task.bed] && plan.tasks[*task.bed].decision.action != Action::fresh)
      chain += prices[*task.bed]->cpu_seconds / std::min(plan.tasks[*task.bed].most_threads, cores);
    whole.wall_seconds = std::max(whole.wall_seconds, chain);
  }
  whole.wall_seconds = std::max(whole.wall_seconds, whole.cpu_seconds / std::max(1, cores));
  return whole;
}

}  // namespace seapile::execute
