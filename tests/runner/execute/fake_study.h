// A study without a file, and a disk without a disk.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "runner/execute/plan.h"

namespace seapile::execute::fake {

inline const std::vector<simulation::NumericsVersion> kNumerics = {{"grains", 1}, {"pile", 1}};

inline std::vector<simulation::NumericsVersion> numerics(const scene::SceneSpec&) { return kNumerics; }

/// A drive called `id` on a bed called `bed_id`; a bed alone when they are the same.
inline study::Case make_case(const std::string& id, const std::string& bed_id) {
  study::Case c;
  c.id = id;
  c.bed_id = bed_id;
  if (id != bed_id) c.scene.pile.emplace();
  c.labels = {{"case", id}};
  return c;
}

/// "drive on bed" pairs become a study.
inline study::Study make_study(const std::vector<std::pair<std::string, std::string>>& cases) {
  study::Study study;
  study.name = "fake";
  for (const auto& [id, bed_id] : cases) study.cases.push_back(make_case(id, bed_id));
  return study;
}

/// What is on the disk, by case id.
struct FakeDisk {
  std::map<std::string, History> histories;

  Disk look() {
    return [this](const std::string& id) { return histories[id]; };
  }
  void complete_bed(const std::string& id, const std::string& run = "0001") {
    histories[id].past = PastRun{run, simulation::Outcome::completed, "", kNumerics, std::nullopt, "", ""};
  }
  void complete_drive(const std::string& id, const std::string& run = "0001", const std::string& bed_run = "0001") {
    histories[id].past = PastRun{run, simulation::Outcome::completed, "", kNumerics, scene::RecordSpec{}, bed_run, ""};
  }
};

/// The task of a case.
inline const Task& task(const Plan& plan, const std::string& id) {
  for (const Task& task : plan.tasks) {
    if (task.id == id) return task;
  }
  throw std::out_of_range("no task " + id);
}

}  // namespace seapile::execute::fake
