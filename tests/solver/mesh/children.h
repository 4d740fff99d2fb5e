// What tests of work in child processes need.
#pragma once

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <new>

namespace seapile::mesh {

constexpr double kShort = 0.2;    ///< for what never ends [s]
constexpr double kForever = 600;  ///< for what ends [s]

[[noreturn]] inline void hang() {
  for (;;) ::pause();
}

/// A number that a child and its parent share.
class Shared {
 public:
  Shared()
      : number_(new (::mmap(nullptr, sizeof(Number), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
                    Number(0)) {}
  ~Shared() { ::munmap(number_, sizeof(Number)); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  std::atomic<int>& operator*() const { return *number_; }

 private:
  using Number = std::atomic<int>;
  Number* number_;
};

/// Counts the children that call it: each has `here` from its parent, who never calls it.
class Children {
 public:
  /// Which child this is, from 1 on.
  int number() {
    if (here_ == 0) here_ = ++*count_;
    return here_;
  }
  int count() const { return *count_; }

 private:
  Shared count_;
  int here_ = 0;
};

/// After each test there is no child, also none that has ended and was not waited for.
class WithChildren : public testing::Test {
 protected:
  void TearDown() override {
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
  }
};

}  // namespace seapile::mesh
