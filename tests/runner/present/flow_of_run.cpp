#include "tests/runner/present/flow_of_run.h"

namespace seapile::present {

using base::Vec2;
using simulation::Entity;

FlowOfRun straight_jet() {
  FlowOfRun run;
  run.title = "jet.reynolds=24";
  run.scene.jet.emplace();
  run.scene.jet->upstream = 1;
  run.scene.jet->downstream = 2;
  std::vector<double> position, x, height;
  std::vector<std::int64_t> corner, top;
  for (std::int64_t j = 0; j <= 2; ++j) {
    for (std::int64_t i = 0; i <= 6; ++i) {
      position.insert(position.end(), {-1 + 0.5 * static_cast<double>(i), 0.5 * static_cast<double>(j)});
      const std::int64_t row = 7 * j + i, above = row + 7;
      if (i < 6 && j < 2) corner.insert(corner.end(), {row, row + 1, above + 1, row, above + 1, above});
      if (j < 2 || i < 2) continue;
      top.push_back(row);
      x.push_back(-1 + 0.5 * static_cast<double>(i));
      height.push_back(1);
    }
  }
  run.frame.vertices = {{{"vertices/position", "m", "", 2, Entity::vertex}, position},
                        {{"vertices/velocity", "m/s", "", 2, Entity::vertex}, std::vector<double>(position.size())}};
  run.frame.triangles = {{{"triangles/corner", "-", "", 3, Entity::triangle}, corner}};
  run.frame.surface = {{{"surface/vertex", "-", "", 1, Entity::surface}, top},
                       {{"surface/x", "m", "", 1, Entity::surface}, x},
                       {{"surface/height", "m", "", 1, Entity::surface}, height}};
  set_velocity(run, [](Vec2 p) { return Vec2{1 + p.y, 0}; });
  return run;
}

FlowOfRun small_basin() {
  FlowOfRun run = straight_jet();
  run.title = "basin.viscosity=0.1 Pa s";
  run.scene.jet.reset();
  basin::BasinSpec& basin = run.scene.basin.emplace();
  basin.width = 3;
  basin.depth = 1;
  run.frame.time = 2.5;
  move(run, [](Vec2 p) { return Vec2{p.x - 0.5, p.y}; });
  std::vector<std::int64_t> top;
  for (std::int64_t i = 0; i <= 6; ++i) top.push_back(14 + i);
  run.frame.surface[0].values = top;
  return run;
}

void move(FlowOfRun& run, Vec2 (*place)(Vec2 place)) {
  auto& position = std::get<std::vector<double>>(run.frame.vertices[0].values);
  for (std::size_t k = 0; k < position.size(); k += 2) {
    const Vec2 p = place({position[k], position[k + 1]});
    position[k] = p.x;
    position[k + 1] = p.y;
  }
}

void set_velocity(FlowOfRun& run, Vec2 (*velocity)(Vec2 place)) {
  const auto& position = std::get<std::vector<double>>(run.frame.vertices[0].values);
  auto& list = std::get<std::vector<double>>(run.frame.vertices[1].values);
  for (std::size_t k = 0; k < position.size(); k += 2) {
    const Vec2 v = velocity({position[k], position[k + 1]});
    list[k] = v.x;
    list[k + 1] = v.y;
  }
}

}  // namespace seapile::present
