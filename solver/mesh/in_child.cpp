#include "solver/mesh/in_child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <sstream>
#include <system_error>
#include <utility>

namespace seapile::mesh {
namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// An end of a pipe.
class End {
 public:
  explicit End(int number) : number_(number) {}
  End(const End&) = delete;
  End& operator=(const End&) = delete;
  ~End() { close(); }
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

/// A child, which does not outlive this.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ == 0) return;
    kill();
    reap();
  }
  void kill() const { ::kill(id_, SIGKILL); }
  /// Waits for its end; 0 where the parent ignores its children's ends and they leave no status.
  int reap() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) continue;
    id_ = 0;
    return status;
  }

 private:
  pid_t id_;
};

/// Where the child finds the pipe, whatever number it had.
constexpr int kOut = STDERR_FILENO + 1;

/// Keeps the pipe alone.
void let_go(int pipe) {
  if (pipe != kOut && ::dup3(pipe, kOut, O_CLOEXEC) < 0) ::_exit(1);
  ::close_range(kOut + 1, ~0U, 0);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (nowhere == standard) continue;
    if (nowhere < 0 || ::dup2(nowhere, standard) < 0) ::close(standard);
  }
  if (nowhere > kOut) ::close(nowhere);
}

void take_off_handlers() {
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  for (const int stop : {SIGHUP, SIGINT, SIGTERM, SIGUSR1}) ::signal(stop, SIG_IGN);
}

void write_all(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(kOut, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) ::_exit(1);
    done += static_cast<std::size_t>(count);
  }
}

/// What is thrown out of the work ends the child by a signal.
[[noreturn]] void be_child(const std::function<std::string()>& work, int pipe, pid_t parent) noexcept {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before the line above, and no signal will come
  take_off_handlers();
  let_go(pipe);
  write_all(work());
  ::_exit(0);
}

/// Reads until the other end is closed; false when that takes longer than `patience` [s].
bool read_all(int pipe, double patience, std::string& text) {
  using Clock = std::chrono::steady_clock;
  constexpr double kLook = 0.2;  // [s]
  std::array<char, 1 << 16> buffer;
  for (double waited = 0; waited < patience;) {
    const double look = std::min(kLook, patience - waited);
    pollfd polled = {pipe, POLLIN, 0};
    const auto start = Clock::now();
    const int ready = ::poll(&polled, 1, static_cast<int>(std::ceil(1e3 * look)));
    waited += std::min(look, std::chrono::duration<double>(Clock::now() - start).count());
    if (ready < 0 && errno != EINTR) fail("poll");
    if (ready <= 0) continue;
    const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
    if (count == 0) return true;
    if (count < 0 && errno != EINTR) fail("read");
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return false;
}

std::string trouble_of(int status) {
  if (WIFSIGNALED(status)) return "ended by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return "ended with code " + std::to_string(WEXITSTATUS(status));
  return "";
}

}  // namespace

Ending in_child(const std::function<std::string()>& work, double patience) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("no pipe for a child");
  End in(ends[0]), out(ends[1]);
  const pid_t parent = ::getpid(), id = ::fork();
  if (id < 0) fail("no child can be started");
  if (id == 0) be_child(work, out.number(), parent);
  Child child(id);
  out.close();
  Ending ending;
  ending.in_time = read_all(in.number(), patience, ending.answer);
  if (!ending.in_time) child.kill();
  const int status = child.reap();
  if (ending.in_time) {
    ending.trouble = trouble_of(status);
  } else {
    std::ostringstream words;
    words << "did not answer within " << patience << " s";
    ending.trouble = words.str();
  }
  return ending;
}

}  // namespace seapile::mesh
