#include "bench/peers/peer_files.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

namespace seapile::peers {
namespace {

constexpr double kHalfThickness = 0.05;  // of the pile drawn out in z [m]; the grains' centres lie at z = 0

template <class T>
const std::vector<T>& values(const std::vector<simulation::Array>& arrays, const std::string& name) {
  for (const simulation::Array& array : arrays)
    if (array.info.name == name) return std::get<std::vector<T>>(array.values);
  throw std::logic_error("the checkpoint has no array " + name);
}

template <class Real>
void take_motion(const std::vector<simulation::Array>& checkpoint, State& state) {
  const auto& velocity = values<Real>(checkpoint, "grains/velocity");
  const auto& surface_speed = values<Real>(checkpoint, "grains/surface_speed");
  for (std::size_t i = 0; i < state.discs.size(); ++i) {
    state.vx.push_back(static_cast<double>(velocity[2 * i]));
    state.vy.push_back(static_cast<double>(velocity[2 * i + 1]));
    state.spin.push_back(static_cast<double>(surface_speed[i]) / state.discs[i].radius);
  }
}

}  // namespace

State state_of(const std::vector<simulation::Array>& checkpoint, grains::Precision precision) {
  State state;
  const auto& position = values<double>(checkpoint, "grains/position");
  const auto& radius = values<double>(checkpoint, "grains/radius");
  for (std::size_t i = 0; i < radius.size(); ++i)
    state.discs.push_back({position[2 * i], position[2 * i + 1], radius[i]});
  if (precision == grains::Precision::single_)
    take_motion<float>(checkpoint, state);
  else
    take_motion<double>(checkpoint, state);
  state.pile_y = values<double>(checkpoint, "pile/motion")[3];
  return state;
}

void write_data(const std::filesystem::path& path, const State& state, const scene::BedSpec& bed) {
  auto file = fmt::output_file(path.string());
  file.print("Grains of a bed with a pile in it\n\n{} atoms\n3 atom types\n\n", state.discs.size());
  file.print("{} {} xlo xhi\n0 {} ylo yhi\n{} {} zlo zhi\n\n", -bed.domain.width / 2, bed.domain.width / 2,
             bed.domain.height, -2 * kHalfThickness, 2 * kHalfThickness);
  file.print("Atoms\n\n");
  for (std::size_t i = 0; i < state.discs.size(); ++i) {
    const Disc& d = state.discs[i];
    // A disc has rho pi r^2 per metre, a sphere 4/3 rho' pi r^3.
    file.print("{} 1 {:.17g} {:.17g} {:.17g} {:.17g} 0\n", i + 1, 2 * d.radius, 0.75 * bed.grains.density / d.radius,
               d.x, d.y);
  }
  file.print("\nVelocities\n\n");
  for (std::size_t i = 0; i < state.discs.size(); ++i)
    file.print("{} {:.9g} {:.9g} 0 0 0 {:.9g}\n", i + 1, state.vx[i], state.vy[i], state.spin[i]);
}

void write_stl(const std::filesystem::path& path, const State& state, const std::vector<base::Segment>& outline) {
  auto file = fmt::output_file(path.string());
  file.print("solid pile\n");
  for (const base::Segment& s : outline) {
    const double from_y = state.pile_y + s.from.y, to_y = state.pile_y + s.to.y;
    const auto triangle = [&](auto... corners) {
      file.print("facet normal 0 0 0\nouter loop\n");
      (file.print("vertex {:.17g} {:.17g} {}\n", corners[0], corners[1], corners[2]), ...);
      file.print("endloop\nendfacet\n");
    };
    const std::array<double, 3> a{s.from.x, from_y, -kHalfThickness}, b{s.to.x, to_y, -kHalfThickness},
        c{s.to.x, to_y, kHalfThickness}, d{s.from.x, from_y, kHalfThickness};
    triangle(a, b, c);
    triangle(a, c, d);
  }
  file.print("endsolid pile\n");
}

void write_facts(const std::filesystem::path& path, const std::vector<Fact>& facts) {
  nlohmann::ordered_json json;
  for (const Fact& f : facts) json[f.name] = f.value;
  fmt::output_file(path.string()).print("{}\n", json.dump(2));
}

double fact(const std::filesystem::path& path, const std::string& name) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + " cannot be read");
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains(name) || !json[name].is_number())
    throw std::runtime_error(path.string() + " has no number \"" + name + "\"");
  return json[name].get<double>();
}

}  // namespace seapile::peers
