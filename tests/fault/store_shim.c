// A library to be preloaded: lets one system call that changes a file below a folder go wrong.
//
//   FAULT_ROOT   the folder
//   FAULT_AT     which call, from 1; all of write, pwrite, fsync, fdatasync, ftruncate, rename and close are counted
//   FAULT_MODE   kill     the process dies (SIGKILL) before the call
//                torn     half of what is to be written is written, then the process dies
//                enospc   the call fails, no space left, once
//                full     the same, and from there on every call that needs space
//                eio      the call fails, input/output error, once; when the process has ended, the machine dies
//                short    half is written, and that is said: no error, and to be gone on with
//                silent   zeros are written in the place of the data, and success is reported
//                power    the machine dies before the call: what is not synced is lost (store_unsynced.h)
//   FAULT_MARK   a file that is created when the call has been reached
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tests/fault/store_unsynced.h"

enum mode { mode_none, mode_kill, mode_torn, mode_enospc, mode_full, mode_eio, mode_short, mode_silent, mode_power };

static const char* const kModes[] = {"", "kill", "torn", "enospc", "full", "eio", "short", "silent", "power"};

static enum mode chosen = mode_none;
static const char* root = "";
static const char* mark = "";
static long fault_at = 0;
static atomic_long count = 0;

__attribute__((constructor)) static void read_environment(void) {
  const char* mode = getenv("FAULT_MODE");
  const char* at = getenv("FAULT_AT");
  if (mode == NULL || at == NULL || getenv("FAULT_ROOT") == NULL || getenv("FAULT_MARK") == NULL) return;
  root = getenv("FAULT_ROOT");
  mark = getenv("FAULT_MARK");
  fault_at = atol(at);
  for (int i = 1; i <= mode_power; ++i) {
    if (strcmp(mode, kModes[i]) == 0) chosen = (enum mode)i;
  }
  unsynced_keep_beside(mark);
}

static int forgets(void) { return chosen == mode_power || chosen == mode_eio; }

__attribute__((destructor)) static void lose_at_the_end(void) {
  if (forgets()) unsynced_lose();
}

// A process that reports an error runs no destructors.
void _exit(int code) {
  lose_at_the_end();
  syscall(SYS_exit_group, code);
  __builtin_unreachable();
}

// The root ends in a slash; the folder itself counts too, since it is synced.
static int is_below_root(const char* path) {
  const size_t length = strlen(root);
  return strncmp(path, root, length) == 0 || (strlen(path) + 1 == length && strncmp(path, root, length - 1) == 0);
}

static int concerns(int descriptor, char* path, size_t size) {
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, size - 1);
  if (length <= 0) return 0;
  path[length] = '\0';
  return is_below_root(path);
}

static void die(void) {
  kill(getpid(), SIGKILL);
  pause();
}

// What is to be done with a call that counts: mode_none, or the chosen mode when it is this call's turn.
static enum mode turn(void) {
  if (chosen == mode_none) return mode_none;
  const long now = atomic_fetch_add(&count, 1) + 1;
  if (now < fault_at) return mode_none;
  if (now == fault_at) {
    const int descriptor = (int)syscall(SYS_openat, AT_FDCWD, mark, O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor >= 0) syscall(SYS_close, descriptor);
    if (chosen == mode_power) unsynced_lose();
    if (chosen == mode_kill || chosen == mode_power) die();
    return chosen;
  }
  return chosen == mode_full ? mode_full : mode_none;
}

static int is_first(void) { return atomic_load(&count) == fault_at; }

static int failed(enum mode mode) {
  errno = mode == mode_eio ? EIO : ENOSPC;
  return -1;
}

// ISO C has no conversion from what dlsym gives to a function.
static void find(void* function, const char* name) {
  if (*(void**)function == NULL) *(void**)function = dlsym(RTLD_NEXT, name);
}

typedef ssize_t (*pwrite_call)(int, const void*, size_t, off64_t);
typedef ssize_t (*write_call)(int, const void*, size_t);

// write(2) where `at` is negative.
static ssize_t put(int descriptor, const void* data, size_t size, off64_t at) {
  static write_call real_write;
  static pwrite_call real_pwrite;
  find(&real_write, "write");
  find(&real_pwrite, "pwrite64");
  char path[4096];
  const int counts = concerns(descriptor, path, sizeof path);
  const enum mode mode = counts ? turn() : mode_none;
  size_t length = size;
  const void* source = data;
  char* zeros = NULL;
  if (mode == mode_enospc || mode == mode_full || mode == mode_eio) return failed(mode);
  if ((mode == mode_torn || mode == mode_short) && size > 1) length = size / 2;
  // What SQLite writes it cannot read back before it says so; that a disk lies there is not to be found out.
  if (mode == mode_silent && strstr(path, "catalogue.sqlite") == NULL) source = zeros = calloc(1, size);
  if (counts && forgets()) unsynced_before_change(path);
  const ssize_t done = at < 0 ? real_write(descriptor, source, length) : real_pwrite(descriptor, source, length, at);
  free(zeros);
  if (mode == mode_torn) die();
  return done;
}

ssize_t write(int descriptor, const void* data, size_t size) { return put(descriptor, data, size, -1); }
ssize_t pwrite(int descriptor, const void* data, size_t size, off_t at) { return put(descriptor, data, size, at); }
ssize_t pwrite64(int descriptor, const void* data, size_t size, off64_t at) { return put(descriptor, data, size, at); }

// A call without data: fails, or is done. What needs no space goes on succeeding on a full disk.
#define PLAIN_CALL(name, parameters, arguments, counts, needs_space, before, after)                                  \
  int name parameters {                                                                                              \
    static int(*real) parameters;                                                                                    \
    find(&real, #name);                                                                                              \
    char path[4096];                                                                                                 \
    (void)path;                                                                                                      \
    const int is_ours = (counts);                                                                                    \
    const enum mode mode = is_ours ? turn() : mode_none;                                                             \
    const int fails = mode == mode_enospc || mode == mode_eio || (mode == mode_full && (needs_space || is_first())); \
    if (is_ours && forgets() && !fails) before;                                                                      \
    const int result = fails ? -1 : real arguments;                                                                  \
    const int error = errno;                                                                                         \
    if (is_ours && forgets()) after;                                                                                 \
    if (mode == mode_torn) die();                                                                                    \
    errno = error;                                                                                                   \
    return fails ? failed(mode) : result;                                                                            \
  }

#define NOTHING ((void)0)

PLAIN_CALL(fsync, (int descriptor), (descriptor), concerns(descriptor, path, sizeof path), 0, NOTHING,
           unsynced_after_sync(path, result))
PLAIN_CALL(fdatasync, (int descriptor), (descriptor), concerns(descriptor, path, sizeof path), 0, NOTHING,
           unsynced_after_sync(path, result))
PLAIN_CALL(ftruncate, (int descriptor, off_t size), (descriptor, size), concerns(descriptor, path, sizeof path), 1,
           unsynced_before_truncation(path, size), NOTHING)
PLAIN_CALL(ftruncate64, (int descriptor, off64_t size), (descriptor, size), concerns(descriptor, path, sizeof path), 1,
           unsynced_before_truncation(path, size), NOTHING)
PLAIN_CALL(rename, (const char* from, const char* to), (from, to), is_below_root(from), 1, unsynced_before_rename(to),
           unsynced_after_rename(from, to, result))

// Watched, but not counted: they make no fault of their own.
int mkdir(const char* folder, mode_t permissions) {
  const int result = (int)syscall(SYS_mkdirat, AT_FDCWD, folder, permissions);
  if (result == 0 && forgets() && is_below_root(folder)) unsynced_after_making(folder);
  return result;
}

int unlink(const char* file) {
  const int result = (int)syscall(SYS_unlinkat, AT_FDCWD, file, 0);
  if (result == 0 && forgets() && is_below_root(file)) unsynced_after_removal(file);
  return result;
}

int close(int descriptor) {
  static int (*real)(int);
  find(&real, "close");
  char path[4096];
  const enum mode mode = concerns(descriptor, path, sizeof path) ? turn() : mode_none;
  // The descriptor is gone in any case, as Linux has it.
  const int result = real(descriptor);
  if (mode == mode_torn) die();
  if (mode == mode_enospc || mode == mode_eio || (mode == mode_full && is_first())) return failed(mode);
  return result;
}
