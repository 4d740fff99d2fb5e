// One combination of a study's axes on its way to a case.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runner/study/grammar.h"
#include "runner/study/problem_collector.h"

namespace seapile::study {

struct Draft {
  Value tree;
  scene::SceneSpec scene;
  base::Problems problems;                                    ///< of reading the tree
  std::vector<std::pair<const Column*, std::string>> unused;  ///< columns, and why they have no place in this scene
  std::set<const Assignment*> used;                           ///< of the command line
};

/// Puts base, axes, variant, conditions and command line over each other. Parts come before what is inside them, so
/// that the order in which a study names its paths does not matter; on the same path the later in this sentence wins.
/// `axis_indices`: the value of each axis; `variant`: null where the study has none; `extra`: what conditions set.
Draft make_draft(const Grammar& grammar, const std::vector<std::size_t>& axis_indices, const Variant* variant,
                 const std::vector<const Assignment*>& extra, ProblemCollector& collector);

}  // namespace seapile::study
