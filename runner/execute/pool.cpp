#include "runner/execute/pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>

#include "runner/execute/exit_codes.h"

namespace seapile::execute {
namespace {

constexpr std::chrono::milliseconds kTick{500};

/// The pool while it works: the plan's tasks with their states.
class Pool {
 public:
  Pool(Plan& plan, const study::Study& study, const Numerics& numerics, const Sharing& sharing, Workers& workers,
       const StoreView& store, const Watch& watch)
      : plan_(plan),
        study_(study),
        numerics_(numerics),
        sharing_(sharing),
        workers_(workers),
        store_(store),
        watch_(watch),
        retried_(plan.tasks.size()),
        threads_(plan.tasks.size()),
        memory_(plan.tasks.size()) {
    for (const Task& task : plan.tasks) {
      summary_.states.push_back(task.decision.action == Action::fresh ? State::fresh : State::waiting);
    }
    summary_.why.resize(plan.tasks.size());
  }

  Summary run() {
    while (true) {
      if (summary_.signals == 0) {
        look_elsewhere();
        promote();
        start_what_fits();
      }
      const bool pending = count(State::waiting) + count(State::ready) + count(State::elsewhere) > 0;
      if (count(State::running) == 0 && (summary_.signals != 0 || !pending)) break;
      if (const auto event = workers_.wait(kTick)) {
        std::visit([this](const auto& e) { handle(e); }, *event);
      }
      watch_.tick();
    }
    for (std::size_t i = 0; i < plan_.tasks.size(); ++i) {
      const State state = summary_.states[i];
      if (state == State::waiting || state == State::ready || state == State::elsewhere) {
        change(i, State::stopped, "not started");
      }
    }
    return std::move(summary_);
  }

 private:
  int count(State state) const { return static_cast<int>(std::ranges::count(summary_.states, state)); }

  void change(std::size_t task, State state, const std::string& why) {
    summary_.states[task] = state;
    summary_.why[task] = why;
    watch_.changed(task, state, why);
  }

  /// Cases that another process ran: once it has let go, they are planned again.
  void look_elsewhere() {
    for (std::size_t i = 0; i < plan_.tasks.size(); ++i) {
      if (summary_.states[i] == State::elsewhere && !store_.claimed(plan_.tasks[i].id)) replan(i);
    }
  }

  void replan(std::size_t i) {
    Task& task = plan_.tasks[i];
    const study::Case& of_study = study_.cases[task.study_case];
    const bool is_bed = task.kind == Kind::bed;
    Asked asked{name(task.kind), numerics_(is_bed ? bed_alone(of_study.scene) : of_study.scene), std::nullopt, ""};
    if (!is_bed) asked.record = record_of_runs(study_.record, of_study.scene);
    if (task.kind == Kind::drive) {
      const History bed = store_.disk(of_study.bed_id);
      asked.bed_run = bed.past ? bed.past->run : "";
    }
    const History history = store_.disk(task.id);
    task.decision = decide(asked, history, store_.equivalences);
    if (task.decision.action == Action::fresh) {
      change(i, State::completed, "by another process");
    } else if (const auto why = diverged_since(task.newest, asked, history)) {
      change(i, State::diverged, "by another process: " + *why);
    } else {
      change(i, State::ready, task.decision.reason);
    }
  }

  /// Drives whose bed has come to an end, and beds, which wait for nothing.
  void promote() {
    for (std::size_t i = 0; i < plan_.tasks.size(); ++i) {
      if (summary_.states[i] != State::waiting) continue;
      const std::optional<std::size_t> bed = plan_.tasks[i].bed;
      const State of_bed = bed ? summary_.states[*bed] : State::completed;
      if (of_bed == State::completed || of_bed == State::fresh) {
        change(i, State::ready, plan_.tasks[i].decision.reason);
      } else if (of_bed == State::diverged || of_bed == State::failed) {
        change(i, State::blocked,
               fmt::format("{} {}", plan_.tasks[*bed].name, of_bed == State::diverged ? "diverged" : "failed"));
      } else if (of_bed == State::stopped) {
        change(i, State::stopped, plan_.tasks[*bed].name + " was stopped");
      }
    }
  }

  void start_what_fits() {
    for (std::size_t i = 0; i < plan_.tasks.size(); ++i) {
      if (summary_.states[i] != State::ready) continue;
      int busy = 0;
      double taken = 0;
      for (std::size_t k = 0; k < plan_.tasks.size(); ++k) {
        if (summary_.states[k] != State::running) continue;
        busy += threads_[k];
        taken += memory_[k];
      }
      const int threads =
          threads_for_next(sharing_, count(State::running), busy, count(State::ready), plan_.tasks[i].most_threads);
      memory_[i] = plan_.tasks[i].memory_mb.value_or(most_seen_[plan_.tasks[i].kind]);
      if (threads == 0 || !memory_suffices(sharing_, taken, memory_[i])) return;
      try {
        workers_.start(i, plan_.tasks[i], threads);
      } catch (const std::system_error& error) {
        change(i, State::failed, fmt::format("no process could be started: {}", error.what()));
        continue;
      }
      threads_[i] = threads;
      summary_.states[i] = State::running;
      watch_.started(i, threads);
    }
  }

  void handle(const Said& said) {
    if (const auto* advanced = std::get_if<Advanced>(&said.message)) watch_.advanced(said.task, advanced->fraction);
  }

  void handle(const Ended& ended) {
    const std::size_t i = ended.task;
    const Verdict verdict = classify(ended.ending);
    const std::string why = in_words(ended.ending);
    const bool stopping = summary_.signals != 0;
    if (verdict == Verdict::completed) {
      if (store_.memory_mb) {
        double& seen = most_seen_[plan_.tasks[i].kind];
        seen = std::max(seen, store_.memory_mb(plan_.tasks[i].id));
      }
      change(i, State::completed, "");
    } else if (verdict == Verdict::stopped || (stopping && verdict == Verdict::killed)) {
      change(i, State::stopped, why);
    } else if (verdict == Verdict::claimed) {
      change(i, State::elsewhere, why);
    } else if (worth_a_retry(verdict) && !retried_[i] && !stopping) {
      retried_[i] = true;
      watch_.retried(i, why);
      change(i, State::ready, why);
    } else {
      change(i, verdict == Verdict::diverged ? State::diverged : State::failed, why);
    }
  }

  void handle(const Signalled& signalled) {
    watch_.signalled(signalled.signal);
    if (++summary_.signals == 1) {
      workers_.ask_to_stop();
    } else {
      workers_.kill();
    }
  }

  Plan& plan_;
  const study::Study& study_;
  const Numerics& numerics_;
  const Sharing& sharing_;
  Workers& workers_;
  const StoreView& store_;
  const Watch& watch_;
  Summary summary_;
  std::vector<bool> retried_;
  std::vector<int> threads_;
  std::vector<double> memory_;        ///< that each was started with [MB]
  std::map<Kind, double> most_seen_;  ///< of those that ended: what one without history is thought to need [MB]
};

}  // namespace

std::string objection(const Sharing& sharing) {
  const long asked = static_cast<long>(sharing.jobs.value_or(1)) * sharing.threads.value_or(1);
  if (asked <= sharing.cores || sharing.oversubscribe) return "";
  return fmt::format("{} jobs with {} threads each need {} cores, there are {}; --oversubscribe runs them all the same",
                     sharing.jobs.value_or(1), sharing.threads.value_or(1), asked, sharing.cores);
}

int threads_for_next(const Sharing& sharing, int running, int busy, int ready, int useful) {
  const int most = sharing.jobs.value_or(sharing.cores);
  const int cores = sharing.oversubscribe ? std::max(sharing.cores, most * sharing.threads.value_or(1)) : sharing.cores;
  const int free = cores - busy;
  if (running >= most || free < 1 || ready < 1) return 0;
  if (sharing.threads) return free >= *sharing.threads ? *sharing.threads : 0;
  return std::clamp(free / std::min(ready, most - running), 1, useful);
}

bool memory_suffices(const Sharing& sharing, double taken, double wanted) {
  return !sharing.memory_mb || taken == 0 || taken + wanted <= *sharing.memory_mb;
}

Summary carry_out(Plan& plan, const study::Study& study, const Numerics& numerics, const Sharing& sharing,
                  Workers& workers, const StoreView& store, const Watch& watch) {
  return Pool(plan, study, numerics, sharing, workers, store, watch).run();
}

int exit_code(const Summary& summary) {
  if (summary.signals > 1) return kInterrupted;
  if (summary.signals > 0) return kStoppedResumable;
  const auto any = [&](auto... states) {
    return std::ranges::any_of(summary.states, [&](State state) { return ((state == states) || ...); });
  };
  if (any(State::failed, State::diverged, State::blocked)) return kSomeCasesFailed;
  return any(State::stopped) ? kStoppedResumable : kDone;
}

}  // namespace seapile::execute
