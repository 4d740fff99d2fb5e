#include "tests/runner/present/frame_of_run.h"

namespace seapile::present {
namespace {

using simulation::Array;
using simulation::Entity;

template <class T>
void append(Array& array, std::initializer_list<T> values) {
  auto& list = std::get<std::vector<T>>(array.values);
  list.insert(list.end(), values);
}

}  // namespace

FrameOfRun empty_run() {
  FrameOfRun run;
  run.title = "pile.tip=flat";
  run.scene.bed.domain = {4, 4, 9.81};
  run.scene.pile.emplace();
  run.scene.pile->radius = 0.1;
  run.scene.pile->tip = pile::FlatTip{};
  run.scene.pile->driving = pile::ConstantDriving{0.1};
  run.surface = 2;
  simulation::Frame& frame = run.frame;
  frame.depth = frame.asked = 0.5;
  const std::vector<double> none;
  const std::vector<std::int64_t> no_ids;
  frame.grains = {{{"grains/id", "-", "", 1, Entity::grain}, no_ids},
                  {{"grains/position", "m", "", 2, Entity::grain}, none},
                  {{"grains/radius", "m", "", 1, Entity::grain}, none},
                  {{"grains/velocity", "m/s", "", 2, Entity::grain}, none},
                  {{"grains/spin", "rad/s", "", 1, Entity::grain}, none},
                  {{"grains/displacement", "m", "", 2, Entity::grain}, none}};
  frame.contacts = {{{"contacts/grain", "-", "", 2, Entity::contact}, no_ids},
                    {{"contacts/position", "m", "", 2, Entity::contact}, none},
                    {{"contacts/normal", "-", "", 2, Entity::contact}, none},
                    {{"contacts/force", "N/m", "", 2, Entity::contact}, none}};
  frame.grid = {-2, 0, 0.1, 40, 40};
  frame.cells = {{{"cells/porosity", "-", "", 1, Entity::cell}, std::vector<double>(1600)},
                 {{"cells/stress", "Pa", "", 3, Entity::cell}, std::vector<double>(4800)},
                 {{"cells/principal_stress", "Pa", "", 2, Entity::cell}, std::vector<double>(3200)},
                 {{"cells/principal_direction", "rad", "", 1, Entity::cell}, std::vector<double>(1600)}};
  return run;
}

void add_grain(FrameOfRun& run, std::int64_t id, base::Vec2 centre, double radius, base::Vec2 velocity,
               base::Vec2 displacement) {
  auto& grains = run.frame.grains;
  append<std::int64_t>(grains[0], {id});
  append(grains[1], {centre.x, centre.y});
  append(grains[2], {radius});
  append(grains[3], {velocity.x, velocity.y});
  append(grains[4], {0.0});
  append(grains[5], {displacement.x, displacement.y});
}

void add_contact(FrameOfRun& run, std::int64_t first, std::int64_t second, base::Vec2 point, double normal_force) {
  auto& contacts = run.frame.contacts;
  append<std::int64_t>(contacts[0], {first, second});
  append(contacts[1], {point.x, point.y});
  append(contacts[2], {1.0, 0.0});
  append(contacts[3], {normal_force, 12345.0});
}

void set_stress(FrameOfRun& run, int column, int row, double major, double minor, double direction) {
  const auto k = static_cast<std::size_t>(row * run.frame.grid.nx + column);
  auto& values = std::get<std::vector<double>>(run.frame.cells[2].values);
  values[2 * k] = major;
  values[2 * k + 1] = minor;
  std::get<std::vector<double>>(run.frame.cells[3].values)[k] = direction;
}

}  // namespace seapile::present
