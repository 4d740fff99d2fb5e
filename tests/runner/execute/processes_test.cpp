// The pool's real processes, with shell scripts in the place of workers.
#include "runner/execute/processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

namespace seapile::execute {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

struct ProcessesTest : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("processes_test_" + std::to_string(::getpid()));
  Task task{Kind::bed, "id", 0, {}, "bed", 1, {}};

  ProcessesTest() { fs::create_directories(folder); }
  ~ProcessesTest() override { fs::remove_all(folder); }

  fs::path script(const std::string& text) {
    const fs::path file = folder / "worker";
    std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
    fs::permissions(file, fs::perms::owner_all);
    return file;
  }
  static Request request(const Task& what) {
    Request request;
    request.case_id = what.id;
    return request;
  }
  /// Everything that comes until the last worker has ended.
  static std::vector<Event> all_events(Processes& processes, int workers) {
    std::vector<Event> events;
    for (int waits = 0; workers > 0 && waits < 100; ++waits) {
      if (auto event = processes.wait(200ms)) {
        if (std::holds_alternative<Ended>(*event)) --workers;
        events.push_back(*event);
      }
    }
    EXPECT_EQ(workers, 0) << "a worker's end was not noticed";
    return events;
  }
};

TEST_F(ProcessesTest, TheRequestGoesInAndTheMessagesComeOut) {
  const fs::path program =
      script("cat > " + (folder / "request").string() + "; echo \"$1 $2\" > " + (folder / "arguments").string() +
             "; echo '{\"fraction\": 0.5}'; echo noise; printf '{\"trouble\": \"sad\"}\\n'; exit 44");
  Processes processes(program, request);
  processes.start(3, task, 7);
  const auto events = all_events(processes, 1);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(std::get<Advanced>(std::get<Said>(events[0]).message).fraction, 0.5);
  const Ended& ended = std::get<Ended>(events[2]);
  EXPECT_EQ(ended.task, 3u);
  EXPECT_EQ(ended.ending.exit_code, 44);
  EXPECT_EQ(ended.ending.signal, 0);
  EXPECT_EQ(ended.ending.trouble, "sad");

  std::ifstream arguments(folder / "arguments"), sent(folder / "request");
  std::string words;
  std::getline(arguments, words);
  EXPECT_EQ(words, "exec -");
  const std::string text{std::istreambuf_iterator<char>(sent), {}};
  EXPECT_NE(text.find("\"threads\":7"), std::string::npos);
  EXPECT_NE(text.find("\"parent\":" + std::to_string(::getpid())), std::string::npos);
}

TEST_F(ProcessesTest, ASignalThatKillsAWorkerIsTold) {
  Processes processes(script("kill -SEGV $$"), request);
  processes.start(0, task, 1);
  EXPECT_EQ(std::get<Ended>(all_events(processes, 1).back()).ending.signal, SIGSEGV);
}

TEST_F(ProcessesTest, EndsAreNoticedOneByOneThoughOthersRunOn) {
  // A worker that inherited the pipe of another one would keep its end from being seen.
  const fs::path program = script("read line; case \"$line\" in *'\"threads\":1'*) exit 0;; esac; exec sleep 60");
  Processes processes(program, request);
  processes.start(0, task, 2);
  processes.start(1, task, 1);
  const auto first_end = processes.wait(5000ms);
  ASSERT_TRUE(first_end);
  EXPECT_EQ(std::get<Ended>(*first_end).task, 1u);
  processes.kill();
  EXPECT_EQ(std::get<Ended>(all_events(processes, 1).back()).ending.signal, SIGKILL);
}

TEST_F(ProcessesTest, SignalsToTheRunnerAreEventsAndDoNotReachTheWorkers) {
  Processes processes(script("exec sleep 60"), request);
  processes.start(0, task, 1);
  ::raise(SIGINT);
  ::raise(SIGTERM);
  const auto first = processes.wait(1000ms), second = processes.wait(1000ms);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(std::get<Signalled>(*first).signal, SIGINT);
  EXPECT_EQ(std::get<Signalled>(*second).signal, SIGTERM);
  EXPECT_FALSE(processes.wait(100ms));  // the worker lives
  processes.ask_to_stop();
  EXPECT_EQ(std::get<Ended>(all_events(processes, 1).back()).ending.signal, SIGTERM);
}

TEST_F(ProcessesTest, AWorkerThatDiesBeforeItReadsTakesNobodyAlong) {
  Processes processes(script("exec 0<&-; exit 9"), [](const Task& what) {
    Request large = request(what);
    large.canonical = std::string(1 << 20, 'x');  // more than a pipe holds
    return large;
  });
  processes.start(0, task, 1);
  EXPECT_EQ(std::get<Ended>(all_events(processes, 1).back()).ending.exit_code, 9);
}

TEST_F(ProcessesTest, AMissingProgramThrows) {
  Processes processes(folder / "nothing", request);
  EXPECT_THROW(processes.start(0, task, 1), std::system_error);
}

TEST_F(ProcessesTest, NoWorkerOutlivesThePool) {
  pid_t worker = 0;
  {
    Processes processes(script("echo $$ > " + (folder / "pid").string() + "; echo '{\"fraction\": 0}'; exec sleep 60"),
                        request);
    processes.start(0, task, 1);
    ASSERT_TRUE(processes.wait(5000ms));
    std::ifstream(folder / "pid") >> worker;
    ASSERT_GT(worker, 0);
    ASSERT_EQ(::kill(worker, 0), 0);
  }
  EXPECT_EQ(::kill(worker, 0), -1);
}

}  // namespace
}  // namespace seapile::execute
