#include "runner/execute/trial.h"

#include <array>
#include <system_error>

#include "solver/mesh/generate.h"

namespace seapile::execute {

MesherTrial trial_of_mesher() {
  const std::array square = {mesh::Corner{{0, 0}}, mesh::Corner{{1, 0}}, mesh::Corner{{1, 1}}, mesh::Corner{{0, 1}}};
  MesherTrial trial;
  try {
    trial.triangles = generate(square, [](base::Vec2) { return 0.25; }).triangle.size();
  } catch (const mesh::NoMesh& error) {
    trial.trouble = error.what();
  } catch (const std::system_error& error) {
    trial.trouble = error.what();
  }
  return trial;
}

}  // namespace seapile::execute
