#include "runner/execute/job.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <optional>

#include "runner/execute/attempt.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/history.h"
#include "runner/execute/notes.h"
#include "runner/execute/plan.h"
#include "runner/execute/provenance.h"
#include "runner/store/run_folder.h"
#include "runner/study/study.h"
#include "solver/simulation/basin.h"
#include "solver/simulation/jet.h"
#include "solver/simulation/run.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;
using simulation::Outcome;

volatile std::sig_atomic_t stop_requested = 0;

void on_stop(int) { stop_requested = 1; }

/// Thrown out of a bed's preparation, which has no checkpoint to stop at.
struct Stopped {};

/// True at most once in `period` seconds.
class Metronome {
 public:
  explicit Metronome(double period) : period_(period) {}
  bool due() {
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - last_).count() < period_) return false;
    last_ = now;
    return true;
  }

 private:
  double period_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// From here on, what is written to standard error lands in the run's own log.
void send_errors_to(const fs::path& log) {
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0) {
    throw store::StoreError(store::StoreError::Kind::io, fmt::format("{}: {}", log.string(), std::strerror(errno)));
  }
  ::dup2(file, STDERR_FILENO);
  ::close(file);
}

template <class... Arguments>
void log(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::print(stderr, format, std::forward<Arguments>(arguments)...);
  std::fputc('\n', stderr);
}

store::RunHeader header_of(const Request& request) {
  store::RunHeader header;
  header.kind = request.kind;
  header.case_id = request.case_id;
  header.canonical = request.canonical;
  header.scene_json = study::to_json(request.scene);
  header.bed_id = request.bed_id;
  header.bed_run = request.bed_run;
  if (is_recorded(request.scene)) header.record_json = study::to_json(request.record, request.scene);
  header.parts = simulation::parts(request.scene);
  header.numerics = simulation::numerics_versions(request.scene);
  return header;
}

/// One claimed case on its way to a sealed run.
class Job {
 public:
  Job(const Request& request, const fs::path& run_folder, const std::function<void(const Message&)>& tell)
      : request_(request), folder_(run_folder), tell_(tell), header_(header_of(request)) {}

  int run(bool resumed) {
    std::error_code error;
    fs::create_directories(folder_, error);
    send_errors_to(folder_ / "log.txt");
    if (const auto earlier = resumed ? read_attempt(folder_) : std::nullopt) attempt_ = *earlier;
    resumed_ = resumed;
    ++attempt_.count;
    attempt_.numerics = header_.numerics;
    attempt_.bed_run = request_.bed_run;
    attempt_.record = record_of_runs(request_.record, request_.scene);
    earlier_ = {attempt_.cpu_seconds, attempt_.wall_seconds};
    write_attempt(folder_, attempt_);
    remove_notes(folder_);

    store::RunWriter writer(folder_, header_);
    log("attempt {} of {} {}, {} threads", attempt_.count, request_.kind, request_.case_id, request_.threads);
    tell_(Started{folder_.filename().string(), !writer.resumable().state.empty()});
    const int code = request_.kind == "bed" ? prepare(writer) : request_.kind == "flow" ? flow(writer) : drive(writer);
    log("ended with code {}", code);
    return code;
  }

 private:
  int prepare(store::RunWriter& writer) {
    const auto& bed_spec = request_.scene.bed;
    const auto given = bed_spec.file.empty() ? std::vector<simulation::Array>{} : study::read_grain_file(bed_spec);
    simulation::RunResult result;
    std::optional<simulation::Bed> bed;
    try {
      bed = simulation::prepare_bed(bed_spec, given, execution(), [this](const simulation::Progress& progress) {
        advance(progress);
        if (stop_requested) throw Stopped{};
      });
      for (const simulation::Record& record : bed->records) writer.add(record);
      result.metrics = bed->metrics;
      result.profile = bed->profile;
      if (!bed->records.empty()) result.time = bed->records.back().time;
    } catch (const Stopped&) {
      log("stopped on request; a bed has no checkpoint and starts again");
      return kStoppedResumable;
    } catch (const store::StoreError&) {
      throw;
    } catch (const std::runtime_error& unsettled) {
      result.outcome = Outcome::diverged;
      result.reason = unsettled.what();
    }
    return finish(writer, result, bed ? &*bed : nullptr);
  }

  int drive(store::RunWriter& writer) {
    const simulation::Bed bed = store::read_bed(store::case_folder(request_.root, request_.bed_id) / request_.bed_run);
    const auto hooks = hooked<simulation::RunHooks>(writer);
    const store::Resumable& resumable = writer.resumable();
    if (!resumable.state.empty()) log("continues after {} records", resumable.records.size());
    return end(writer, simulation::run(request_.scene, request_.record, bed, execution(), resumable.state,
                                       {resumable.records, resumable.flow_records}, hooks));
  }

  int flow(store::RunWriter& writer) {
    const store::Resumable& resumable = writer.resumable();
    const scene::SceneSpec scene = scene::as_built(request_.scene);
    if (scene.jet) {
      const auto hooks = hooked<simulation::JetHooks>(writer);
      return end(writer, simulation::run_jet(*scene.jet, execution(), resumable.state, hooks));
    }
    const auto hooks = hooked<simulation::BasinHooks>(writer);
    if (!resumable.state.empty()) log("continues after {} records", resumable.flow_records.size());
    return end(writer, simulation::run_basin(*scene.basin, request_.record, execution(), resumable.state,
                                             resumable.flow_records, hooks));
  }

  /// What a run hands out goes to the writer, and what it asks is answered, whatever kind it is of.
  template <class Hooks>
  Hooks hooked(store::RunWriter& writer) {
    Hooks hooks;
    if constexpr (requires { hooks.record; }) hooks.record = [&writer](const auto& record) { writer.add(record); };
    hooks.frame = [&writer](const auto& frame) { writer.add(frame); };
    if constexpr (requires { hooks.flow_record; }) {
      hooks.flow_record = [&writer](const simulation::FlowRecord& record) { writer.add(record); };
      hooks.flow_frame = [&writer](const simulation::FlowFrame& frame) { writer.add(frame); };
    }
    hooks.progress = [this](const simulation::Progress& progress) { advance(progress); };
    hooks.checkpoint_due = [this] { return checkpoints_.due(); };
    hooks.checkpoint = [this, &writer](const std::vector<simulation::Array>& state) {
      writer.checkpoint(state);
      note_cost();
    };
    hooks.stop = [] { return stop_requested != 0; };
    if constexpr (requires { hooks.post_mortem; })
      hooks.post_mortem = [&writer](const std::vector<simulation::Array>& rejected, const std::string& reason) {
        log("diverged: {}", reason);
        try {
          writer.post_mortem(rejected, reason);
        } catch (const store::StoreError& error) {  // the run's end is worth more than the state that it died of
          log("the rejected state is not kept: {}", error.what());
        }
      };
    return hooks;
  }

  int end(store::RunWriter& writer, const simulation::RunResult& result) {
    if (result.outcome == Outcome::stopped) {
      log("{}", result.reason);
      return kStoppedResumable;
    }
    return finish(writer, result, nullptr);
  }

  int finish(store::RunWriter& writer, const simulation::RunResult& result, const simulation::Bed* bed) {
    store::Provenance made = provenance();
    made.threads = request_.threads;
    made.simd = simulation::simd_in_use(execution().simd);
    const Cost cost = cost_so_far();
    made.cpu_seconds = earlier_.cpu_seconds + cost.cpu_seconds;
    made.wall_seconds = earlier_.wall_seconds + cost.wall_seconds;
    made.peak_memory_mb = peak_memory_mb();
    made.attempts = attempt_.count;
    writer.finish(result, std::move(made), bed);
    remove_attempt(folder_);
    remove_notes(folder_);
    if (result.outcome == Outcome::completed) return kDone;
    tell_(Trouble{result.reason});
    return kDiverged;
  }

  simulation::Execution execution() const {
    simulation::Execution execution;
    execution.threads = request_.threads;
    return execution;
  }

  void advance(const simulation::Progress& progress) {
    // A run that was resumed is first heard of where it goes on.
    if (!start_fraction_) start_fraction_ = resumed_ ? progress.fraction : 0;
    if (!second_.due()) return;
    tell_(Advanced{progress.fraction});
    write_progress(folder_, {progress.fraction, *start_fraction_, cost_so_far().wall_seconds, request_.threads, ""});
  }

  void note_cost() {
    const Cost cost = cost_so_far();
    attempt_.cpu_seconds = earlier_.cpu_seconds + cost.cpu_seconds;
    attempt_.wall_seconds = earlier_.wall_seconds + cost.wall_seconds;
    write_attempt(folder_, attempt_);
  }

  const Request& request_;
  fs::path folder_;
  const std::function<void(const Message&)>& tell_;
  store::RunHeader header_;
  Attempt attempt_;
  Cost earlier_;
  bool resumed_ = false;
  std::optional<double> start_fraction_;
  Metronome second_{1};
  Metronome checkpoints_{request_.checkpoint_every};
};

int run_claimed(const Request& request, const std::function<void(const Message&)>& tell) {
  const fs::path case_folder = store::case_folder(request.root, request.case_id);
  const auto claim = store::Claim::take(case_folder);
  if (!claim) {
    tell(Trouble{"another process runs this case"});
    return kClaimHeld;
  }
  // Decided under the claim: another runner may have finished the case since the plan was made.
  const Asked asked{request.kind, simulation::numerics_versions(request.scene),
                    record_of_runs(request.record, request.scene), request.bed_run};
  const History history = read_history(request.root, request.case_id);
  const Decision decision = decide(asked, history, store::read_equivalences(request.root).declared);
  if (decision.action == Action::fresh) return kDone;
  if (const auto why = diverged_since(request.newest, asked, history)) {
    tell(Trouble{*why});
    return kDiverged;
  }
  const std::string run = decision.run.empty() ? store::next_run(case_folder, false) : decision.run;
  return Job(request, case_folder / run, tell).run(decision.action == Action::resume);
}

/// Why the bed that a drive is to be built on cannot be used, or "" once `bed_run` names its newest run: a batch system
/// is asked for the drive before there is one.
std::string find_bed(Request& request) {
  const Asked asked{name(Kind::bed), simulation::numerics_versions(bed_alone(request.scene)), std::nullopt, ""};
  const History history = read_history(request.root, request.bed_id);
  const Decision decision = decide(asked, history, store::read_equivalences(request.root).declared);
  request.bed_run = decision.run;
  if (decision.action == Action::fresh) return "";
  return fmt::format("its bed {} cannot be had: {}", short_id(request.bed_id), decision.reason);
}

int code_of(store::StoreError::Kind kind) {
  using Kind = store::StoreError::Kind;
  switch (kind) {
    case Kind::io:
    case Kind::locked:
      return kIoFailed;
    case Kind::sync:
      return kSyncFailed;
    case Kind::verify:
    case Kind::damaged:
      return kVerifyFailed;
  }
  return kInternalError;
}

}  // namespace

bool die_with(int parent) {
  if (parent == 0) return true;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  return ::getppid() == parent;  // otherwise it died before the line above, and no signal will come
}

void listen_for_stop() {
  struct sigaction action = {};
  action.sa_handler = on_stop;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) ::sigaction(signal, &action, nullptr);
}

int work(const Request& request, const std::function<void(const Message&)>& tell) {
  const auto trouble = [&](int code, const std::string& sentence) {
    log("{}", sentence);
    tell(Trouble{sentence});
    return code;
  };
  try {
    if (request.kind != "drive" || !request.bed_run.empty()) return run_claimed(request, tell);
    Request on_bed = request;
    if (const std::string objection = find_bed(on_bed); !objection.empty()) return trouble(kBedMissing, objection);
    return run_claimed(on_bed, tell);
  } catch (const store::StoreError& error) {
    return trouble(code_of(error.kind), error.what());
  } catch (const study::BadInput& error) {
    return trouble(kBadRequest, error.what());
  } catch (const std::exception& error) {
    return trouble(kInternalError, error.what());
  }
}

}  // namespace seapile::execute
