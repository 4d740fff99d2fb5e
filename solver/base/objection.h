// Why a step cannot be accepted.
#pragma once

#include <array>
#include <string>

namespace seapile::base {

enum class Cause { not_finite, path, overlap, residual, mesh, flow, porosity, volume, energy };

inline constexpr int kCauses = 9;

/// A cause's name, and what is objected to, one clause.
struct CauseText {
  const char* name;
  const char* meaning;
};
inline constexpr std::array<CauseText, kCauses> kCauseTexts{{
    {"not_finite", "a number of grains, flow or surface was not finite"},
    {"path", "a grain moved too far within a step"},
    {"overlap", "two bodies overlapped too much"},
    {"residual", "the contacts' equations were left too far from solved"},
    {"mesh", "there was no valid mesh for surface and pile, along the whole way"},
    {"flow", "the flow's equations were not solved"},
    {"porosity", "grains filled more of the mesh than there is room for"},
    {"volume", "the volume of water, or of water and grains, was not kept"},
    {"energy", "the grains had energy that nothing had given them"},
}};

constexpr const CauseText& text_of(Cause cause) { return kCauseTexts[static_cast<std::size_t>(cause)]; }

/// None when it is empty.
struct Objection {
  Cause cause = Cause::not_finite;
  std::string why = {};  ///< one sentence
  bool empty() const { return why.empty(); }
};

}  // namespace seapile::base
