#define _GNU_SOURCE
#include "tests/fault/store_unsynced.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

// System calls are made directly: the library would count its own.

enum { kMost = 1000 };

struct file {
  char* path;
  char* before;  // a copy of what was synced last
  int lost;
};

struct name {
  char* from;  // NULL: a folder was made
  char* to;
  char* before;  // what had the name; NULL: nothing
  int lost;
};

static struct file files[kMost];
static struct name names[kMost];
static int file_count = 0, name_count = 0, copies = 0;
static const char* prefix = "";
static char* replaced = NULL;  // by the rename that goes on

static void require(int condition) {
  if (!condition) abort();
}

static char* fresh_copy_name(void) {
  char* name = NULL;
  require(asprintf(&name, "%s.%d", prefix, ++copies) > 0);
  syscall(SYS_unlinkat, AT_FDCWD, name, 0);
  return name;
}

static void copy(const char* from, const char* to, int flags) {
  const int in = (int)syscall(SYS_openat, AT_FDCWD, from, O_RDONLY | O_CLOEXEC, 0);
  const int out = (int)syscall(SYS_openat, AT_FDCWD, to, O_WRONLY | O_TRUNC | O_CLOEXEC | flags, 0644);
  char buffer[1 << 16];
  for (long got; in >= 0 && out >= 0 && (got = syscall(SYS_read, in, buffer, sizeof buffer)) > 0;) {
    require(syscall(SYS_write, out, buffer, got) == got);
  }
  if (in >= 0) syscall(SYS_close, in);
  if (out >= 0) syscall(SYS_close, out);
}

static int rename_directly(const char* from, const char* to) {
  return (int)syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to);
}

static int is_in(const char* path, const char* folder) {
  const size_t length = strlen(folder);
  return strncmp(path, folder, length) == 0 && path[length] == '/' && strchr(path + length + 1, '/') == NULL;
}

static void forget_file(const char* path) {
  for (int i = 0; i < file_count; ++i) {
    if (strcmp(files[i].path, path) == 0) files[i--] = files[--file_count];
  }
}

static void move_file(const char* from, const char* to) {
  for (int i = 0; i < file_count; ++i) {
    if (strcmp(files[i].path, from) == 0) files[i].path = strdup(to);
  }
}

void unsynced_keep_beside(const char* name) { prefix = name; }

void unsynced_before_change(const char* path) {
  for (int i = 0; i < file_count; ++i) {
    if (strcmp(files[i].path, path) == 0) return;
  }
  require(file_count < kMost);
  char* before = fresh_copy_name();
  copy(path, before, O_CREAT);
  files[file_count++] = (struct file){strdup(path), before, 0};
}

void unsynced_before_truncation(const char* path, long long size) {
  unsynced_before_change(path);
  for (int i = 0; i < file_count; ++i) {
    if (size == 0 && strcmp(files[i].path, path) == 0) files[i].lost = 0;
  }
}

void unsynced_after_sync(const char* path, int result) {
  for (int i = 0; i < file_count; ++i) {
    if (strcmp(files[i].path, path) != 0) continue;
    if (result != 0) files[i].lost = 1;
    if (!files[i].lost) files[i--] = files[--file_count];
  }
  int kept = 0;
  for (int i = 0; i < name_count; ++i) {
    const int here = is_in(names[i].to, path);
    if (here && result != 0) names[i].lost = 1;
    if (!here || names[i].lost) names[kept++] = names[i];
  }
  name_count = kept;
}

void unsynced_before_rename(const char* to) {
  replaced = fresh_copy_name();
  if (syscall(SYS_linkat, AT_FDCWD, to, AT_FDCWD, replaced, 0) != 0) replaced = NULL;
}

void unsynced_after_rename(const char* from, const char* to, int result) {
  if (result != 0) return;
  require(name_count < kMost);
  forget_file(to);
  move_file(from, to);
  names[name_count++] = (struct name){strdup(from), strdup(to), replaced, 0};
}

void unsynced_after_making(const char* folder) {
  require(name_count < kMost);
  names[name_count++] = (struct name){NULL, strdup(folder), NULL, 0};
}

void unsynced_after_removal(const char* path) { forget_file(path); }

void unsynced_lose(void) {
  while (name_count > 0) {
    const struct name* name = &names[--name_count];
    rename_directly(name->to, name->from != NULL ? name->from : fresh_copy_name());
    if (name->from != NULL) move_file(name->to, name->from);
    if (name->before != NULL) rename_directly(name->before, name->to);
  }
  for (int i = 0; i < file_count; ++i) copy(files[i].before, files[i].path, 0);
  file_count = 0;
}
