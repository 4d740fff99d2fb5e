// A library to be preloaded: lets one system call that changes a file below a folder go wrong.
//
//   FAULT_ROOT   the folder
//   FAULT_AT     which call, from 1; all of write, pwrite, fsync, fdatasync, ftruncate, rename and close are counted
//   FAULT_MODE   kill     the process dies (SIGKILL) before the call
//                torn     half of what is to be written is written, then the process dies
//                enospc   the call fails, no space left, once
//                full     the same, and from there on every call that needs space
//                eio      the call fails, input/output error, once
//                short    half is written, and that is said: no error, and to be gone on with
//                silent   zeros are written in the place of the data, and success is reported
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

enum mode { mode_none, mode_kill, mode_torn, mode_enospc, mode_full, mode_eio, mode_short, mode_silent };

static const char* const kModes[] = {"", "kill", "torn", "enospc", "full", "eio", "short", "silent"};

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
  for (int i = 1; i <= mode_silent; ++i) {
    if (strcmp(mode, kModes[i]) == 0) chosen = (enum mode)i;
  }
}

static int is_below_root(const char* path) { return strncmp(path, root, strlen(root)) == 0; }

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
    if (chosen == mode_kill) die();
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
  const enum mode mode = concerns(descriptor, path, sizeof path) ? turn() : mode_none;
  size_t length = size;
  const void* source = data;
  char* zeros = NULL;
  if (mode == mode_enospc || mode == mode_full || mode == mode_eio) return failed(mode);
  if ((mode == mode_torn || mode == mode_short) && size > 1) length = size / 2;
  // What SQLite writes it cannot read back before it says so; that a disk lies there is not to be found out.
  if (mode == mode_silent && strstr(path, "catalogue.sqlite") == NULL) source = zeros = calloc(1, size);
  const ssize_t done = at < 0 ? real_write(descriptor, source, length) : real_pwrite(descriptor, source, length, at);
  free(zeros);
  if (mode == mode_torn) die();
  return done;
}

ssize_t write(int descriptor, const void* data, size_t size) { return put(descriptor, data, size, -1); }
ssize_t pwrite(int descriptor, const void* data, size_t size, off_t at) { return put(descriptor, data, size, at); }
ssize_t pwrite64(int descriptor, const void* data, size_t size, off64_t at) { return put(descriptor, data, size, at); }

// A call without data: fails, or is done. What needs no space goes on succeeding on a full disk.
#define PLAIN_CALL(name, parameters, arguments, counts, needs_space)           \
  int name parameters {                                                        \
    static int(*real) parameters;                                              \
    find(&real, #name);                                                        \
    char path[4096];                                                           \
    (void)path;                                                                \
    const enum mode mode = (counts) ? turn() : mode_none;                      \
    if (mode == mode_enospc || mode == mode_eio) return failed(mode);          \
    if (mode == mode_full && (needs_space || is_first())) return failed(mode); \
    const int result = real arguments;                                         \
    if (mode == mode_torn) die();                                              \
    return result;                                                             \
  }

PLAIN_CALL(fsync, (int descriptor), (descriptor), concerns(descriptor, path, sizeof path), 0)
PLAIN_CALL(fdatasync, (int descriptor), (descriptor), concerns(descriptor, path, sizeof path), 0)
PLAIN_CALL(ftruncate, (int descriptor, off_t size), (descriptor, size), concerns(descriptor, path, sizeof path), 1)
PLAIN_CALL(ftruncate64, (int descriptor, off64_t size), (descriptor, size), concerns(descriptor, path, sizeof path), 1)
PLAIN_CALL(rename, (const char* from, const char* to), (from, to), is_below_root(from), 1)

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
