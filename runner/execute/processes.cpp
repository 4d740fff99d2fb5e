#include "runner/execute/processes.h"

#include <fcntl.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/group.hpp>
#include <boost/process/posix.hpp>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <deque>
#include <list>
#include <string>
#include <system_error>

#include "runner/execute/descriptor.h"

namespace seapile::execute {
namespace {

namespace bp = boost::process;

constexpr std::array kWatchedSignals = {SIGINT, SIGTERM, SIGHUP};

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

struct Pipe {
  Descriptor read, write;
};

/// Both ends close on exec, so that no worker holds an end of another one's pipe open.
Pipe make_pipe(int flags) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC | flags) != 0) fail("pipe");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

// What the signal handler may touch: the write end of a pipe that wait() reads.
volatile std::sig_atomic_t signal_pipe = -1;

void on_signal(int signal) {
  const int saved = errno;
  const auto byte = static_cast<unsigned char>(signal);
  [[maybe_unused]] const auto written = ::write(static_cast<int>(signal_pipe), &byte, 1);
  errno = saved;
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return;  // The worker is gone already; its end tells more than this does.
    done += static_cast<std::size_t>(written);
  }
}

/// One worker process and the part of a line that it has written so far.
struct Worker {
  std::size_t task;
  bp::group group;
  bp::child child;
  Descriptor messages;
  std::string partial;
  std::string trouble;
};

}  // namespace

struct Processes::Impl {
  std::filesystem::path program;
  std::function<Request(const Task&)> request;
  std::list<Worker> workers;
  std::deque<Event> events;
  Pipe signals = make_pipe(O_NONBLOCK);
  std::array<struct sigaction, kWatchedSignals.size()> previous = {};
  struct sigaction previous_pipe = {};

  /// Takes in what a worker wrote; at its end of file, the worker is over.
  void listen(std::list<Worker>::iterator worker) {
    std::array<char, 4096> buffer;
    const ssize_t count = ::read(worker->messages.number(), buffer.data(), buffer.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (count > 0) {
      worker->partial.append(buffer.data(), static_cast<std::size_t>(count));
      for (std::size_t end; (end = worker->partial.find('\n')) != std::string::npos;) {
        const auto message = decode(worker->partial.substr(0, end));
        worker->partial.erase(0, end + 1);
        if (!message) continue;
        if (const auto* trouble = std::get_if<Trouble>(&*message)) worker->trouble = trouble->sentence;
        events.push_back(Said{worker->task, *message});
      }
      return;
    }
    worker->child.wait();
    const int status = worker->child.native_exit_code();
    const Ending ending{WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                        worker->trouble};
    events.push_back(Ended{worker->task, ending});
    workers.erase(worker);
  }
};

Processes::Processes(std::filesystem::path program, std::function<Request(const Task&)> request)
    : impl_(std::make_unique<Impl>()) {
  assert(signal_pipe == -1 && "one at a time: signals have one receiver");
  impl_->program = std::move(program);
  impl_->request = std::move(request);
  signal_pipe = impl_->signals.write.number();
  struct sigaction action = {};
  action.sa_handler = on_signal;
  for (std::size_t i = 0; i < kWatchedSignals.size(); ++i) {
    ::sigaction(kWatchedSignals[i], nullptr, &impl_->previous[i]);
    // What the user has switched off (nohup) stays off.
    if (impl_->previous[i].sa_handler != SIG_IGN) ::sigaction(kWatchedSignals[i], &action, nullptr);
  }
  action.sa_handler = SIG_IGN;  // A worker that dies before it has read its request must not take the runner along.
  ::sigaction(SIGPIPE, &action, &impl_->previous_pipe);
}

Processes::~Processes() {
  kill();
  for (Worker& worker : impl_->workers) {
    std::error_code ignored;
    worker.child.wait(ignored);
  }
  for (std::size_t i = 0; i < kWatchedSignals.size(); ++i) {
    ::sigaction(kWatchedSignals[i], &impl_->previous[i], nullptr);
  }
  ::sigaction(SIGPIPE, &impl_->previous_pipe, nullptr);
  signal_pipe = -1;
}

void Processes::start(std::size_t task, const Task& what, int threads) {
  Request request = impl_->request(what);
  request.threads = threads;
  request.parent = ::getpid();
  Pipe input = make_pipe(0), output = make_pipe(0);
  bp::group group;
  bp::child child(bp::exe = impl_->program.string(), bp::args = {"exec", "-"},
                  bp::posix::fd.bind(STDIN_FILENO, input.read.number()),
                  bp::posix::fd.bind(STDOUT_FILENO, output.write.number()), group);
  input.read.close();
  output.write.close();
  ::fcntl(output.read.number(), F_SETFL, O_NONBLOCK);
  write_all(input.write.number(), to_json(request));
  impl_->workers.push_back({task, std::move(group), std::move(child), std::move(output.read), "", ""});
}

std::optional<Event> Processes::wait(std::chrono::milliseconds patience) {
  if (impl_->events.empty()) {
    std::vector<pollfd> polled = {{impl_->signals.read.number(), POLLIN, 0}};
    for (const Worker& worker : impl_->workers) polled.push_back({worker.messages.number(), POLLIN, 0});
    if (::poll(polled.data(), polled.size(), static_cast<int>(patience.count())) < 0 && errno != EINTR) fail("poll");
    unsigned char signal = 0;
    while (::read(impl_->signals.read.number(), &signal, 1) == 1) impl_->events.push_back(Signalled{signal});
    std::size_t i = 1;
    for (auto worker = impl_->workers.begin(); worker != impl_->workers.end(); ++i) {
      const auto current = worker++;  // listen() may erase it
      if (polled[i].revents != 0) impl_->listen(current);
    }
  }
  if (impl_->events.empty()) return std::nullopt;
  Event event = std::move(impl_->events.front());
  impl_->events.pop_front();
  return event;
}

void Processes::ask_to_stop() {
  for (const Worker& worker : impl_->workers) ::kill(worker.child.id(), SIGTERM);
}

void Processes::kill() {
  for (const Worker& worker : impl_->workers) ::kill(worker.child.id(), SIGKILL);
}

}  // namespace seapile::execute
