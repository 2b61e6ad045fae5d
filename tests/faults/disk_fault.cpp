// What a disk and a system may do to a program, put between it and the C library (LD_PRELOAD), for one
// process and the files whose path contains FAULT_PATH:
//
//   FAULT_PROGRAM  name of the program, FAULT_RANK  of the process (0 by default): in others nothing happens
//   FAULT_LOG      a file that gets a line for each call that writes, makes, renames or removes such a file
//   FAULT_KILL_AT  number of the call before which the process is killed (SIGKILL), counted from 1;
//   FAULT_HALF     where it is a write, after half of it
//   FAULT_ROOM     bytes by which such files may grow before "No space left on device"; nothing can be
//   reserved
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <string>

namespace {

template <class Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}
#define NEXT(name) static const auto real = next(&::name, #name)

long number(const char* name, long otherwise) {
  const char* const text = getenv(name);
  return text ? atol(text) : otherwise;
}

bool here() {
  static const bool found = [] {
    const char *const program = getenv("FAULT_PROGRAM"), *const rank = getenv("OMPI_COMM_WORLD_RANK");
    return program && strcmp(program, program_invocation_short_name) == 0 &&
           (rank ? atol(rank) : 0) == number("FAULT_RANK", 0);
  }();
  return found;
}

bool meant(const char* path) {
  static const char* const part = getenv("FAULT_PATH");
  return here() && part && path && strstr(path, part);
}

std::string path_of(int file) {
  char path[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = readlink(link.c_str(), path, sizeof path);
  return length > 0 ? std::string(path, static_cast<size_t>(length)) : std::string();
}

bool meant(int file) { return here() && meant(path_of(file).c_str()); }

[[noreturn]] void die() {
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

/// Counts a call; true when it is the last of this process.
bool last(const char* call, const std::string& path, size_t bytes) {
  static long calls = 0;
  ++calls;
  if (const char* const log = getenv("FAULT_LOG")) {
    NEXT(write);
    static const int file = open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    const std::string line =
        std::to_string(calls) + " " + call + " " + std::to_string(bytes) + " " + path + "\n";
    (void)!real(file, line.data(), line.size());
  }
  return calls == number("FAULT_KILL_AT", -1);
}

void count(const char* call, const std::string& path) {
  if (last(call, path, 0)) die();
}

/// How many of the bytes, of which so many lie behind the file's end, find room.
size_t room_for(size_t bytes, size_t behind) {
  static long room = number("FAULT_ROOM", -1);
  static const bool limited = room >= 0;
  if (!limited) return bytes;
  const size_t grows = static_cast<size_t>(room) < behind ? static_cast<size_t>(room) : behind;
  room -= static_cast<long>(grows);
  return bytes - (behind - grows);
}

size_t behind_end(int file, off_t at, size_t bytes) {
  struct stat status {};
  if (fstat(file, &status) != 0) return 0;
  const off_t end = at + static_cast<off_t>(bytes);
  if (end <= status.st_size) return 0;
  return at >= status.st_size ? bytes : static_cast<size_t>(end - status.st_size);
}

/// The write `put(bytes)` at a place of a file, as the disk takes it.
template <class Put>
ssize_t written(const char* call, int file, off_t at, size_t bytes, Put put) {
  if (!meant(file)) return put(bytes);
  if (last(call, path_of(file), bytes)) {
    if (getenv("FAULT_HALF")) (void)!put(bytes / 2);
    die();
  }
  const size_t fits = room_for(bytes, behind_end(file, at, bytes));
  if (fits == 0 && bytes > 0) {
    errno = ENOSPC;
    return -1;
  }
  return put(fits);
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* from, size_t bytes) {
  NEXT(write);
  return written("write", file, here() ? lseek(file, 0, SEEK_CUR) : 0, bytes,
                 [&](size_t fits) { return real(file, from, fits); });
}

ssize_t pwrite(int file, const void* from, size_t bytes, off_t at) {
  NEXT(pwrite);
  return written("write", file, at, bytes, [&](size_t fits) { return real(file, from, fits, at); });
}

ssize_t pwrite64(int file, const void* from, size_t bytes, off64_t at) {
  NEXT(pwrite64);
  return written("write", file, at, bytes, [&](size_t fits) { return real(file, from, fits, at); });
}

ssize_t writev(int file, const struct iovec* parts, int parts_count) {
  NEXT(writev);
  if (!meant(file)) return real(file, parts, parts_count);
  ssize_t all = 0;
  for (int k = 0; k < parts_count; ++k) {
    const ssize_t part = write(file, parts[k].iov_base, parts[k].iov_len);
    if (part < 0) return all > 0 ? all : -1;
    all += part;
    if (static_cast<size_t>(part) < parts[k].iov_len) break;
  }
  return all;
}

size_t fwrite(const void* from, size_t size, size_t count_of, FILE* stream) {
  NEXT(fwrite);
  if (!here() || !meant(fileno(stream))) return real(from, size, count_of, stream);
  const size_t bytes = size * count_of;
  const ssize_t done = written("write", fileno(stream), ftell(stream), bytes, [&](size_t fits) {
    const size_t put = real(from, 1, fits, stream);
    if (fits < bytes) (void)fflush(stream);
    return static_cast<ssize_t>(put);
  });
  if (static_cast<size_t>(done) < bytes) errno = ENOSPC;
  return done < 0 ? 0 : static_cast<size_t>(done) / size;
}

int ftruncate(int file, off_t size) {
  NEXT(ftruncate);
  if (meant(file)) count("truncate", path_of(file));
  return real(file, size);
}

int ftruncate64(int file, off64_t size) {
  NEXT(ftruncate64);
  if (meant(file)) count("truncate", path_of(file));
  return real(file, size);
}

int rename(const char* from, const char* to) {
  NEXT(rename);
  if (meant(from) || meant(to)) count("rename", to);
  return real(from, to);
}

int unlink(const char* path) {
  NEXT(unlink);
  if (meant(path)) count("unlink", path);
  return real(path);
}

int remove(const char* path) noexcept {
  NEXT(remove);
  if (meant(path)) count("remove", path);
  return real(path);
}

int fallocate(int file, int mode, off_t at, off_t bytes) {
  NEXT(fallocate);
  if (getenv("FAULT_ROOM") && meant(file)) {
    errno = EOPNOTSUPP;
    return -1;
  }
  return real(file, mode, at, bytes);
}

int fallocate64(int file, int mode, off64_t at, off64_t bytes) {
  NEXT(fallocate64);
  if (getenv("FAULT_ROOM") && meant(file)) {
    errno = EOPNOTSUPP;
    return -1;
  }
  return real(file, mode, at, bytes);
}

}  // extern "C"
