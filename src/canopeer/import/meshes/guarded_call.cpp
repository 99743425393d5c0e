#include "canopeer/import/meshes/guarded_call.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

namespace canopeer {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitMemory = false;  // sanitizers reserve terabytes of addresses
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kLimitMemory = false;
#else
constexpr bool kLimitMemory = true;
#endif
#else
constexpr bool kLimitMemory = true;
#endif

constexpr double kPatience = 10.0;  // seconds on the clock for each of processor time
constexpr char kValue = 'v';        // the first byte the child sends: bytes follow …
constexpr char kError = 'e';        // … or the text of an error

std::size_t address_space_bytes() {
  std::size_t pages = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r"); file != nullptr) {
    if (std::fscanf(file, "%zu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

rlim_t whole_seconds(double seconds) { return static_cast<rlim_t>(std::ceil(seconds)); }

void set_limit(__rlimit_resource what, rlim_t soft, rlim_t hard) {
  const rlimit limit{soft, hard};
  ::setrlimit(what, &limit);
}

void send_all(int to, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t sent = ::write(to, bytes, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) ::_exit(1);
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

/// What the child does; it never returns. No destructor of the caller's runs in it.
[[noreturn]] void be_the_child(const std::function<std::string()>& call, const CallLimits& limits,
                               pid_t parent, int to) {
  for (const int signal : {SIGINT, SIGTERM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    std::signal(signal, SIG_DFL);
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  if (const int nowhere = ::open("/dev/null", O_WRONLY); nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  set_limit(RLIMIT_CORE, 0, 0);
  set_limit(RLIMIT_CPU, whole_seconds(limits.cpu_s), whole_seconds(limits.cpu_s) + 1);
  if (kLimitMemory) {
    const rlim_t bytes = address_space_bytes() + limits.memory_bytes;
    set_limit(RLIMIT_AS, bytes, bytes);
  }
  try {
    const std::string value = call();
    send_all(to, &kValue, 1);
    send_all(to, value.data(), value.size());
  } catch (const std::bad_alloc&) {
    const char text[] = "eits reader would need more memory than there is for it";
    send_all(to, text, sizeof text - 1);
  } catch (const std::exception& error) {
    send_all(to, &kError, 1);
    send_all(to, error.what(), std::strlen(error.what()));
  }
  ::_exit(0);
}

/// Everything the child sends until it ends; false: it said nothing for too long.
bool receive(int from, double patience_s, std::string* bytes) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(patience_s));
  std::array<char, 1 << 16> buffer;
  while (true) {
    pollfd ready{from, POLLIN, 0};
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) return false;
    // In slices: what waits longer than an int of milliseconds is none of ours.
    const auto slice = std::min<std::chrono::milliseconds::rep>(left.count(), 60000);
    if (::poll(&ready, 1, static_cast<int>(slice)) <= 0) continue;
    const ssize_t got = ::read(from, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return true;
    bytes->append(buffer.data(), static_cast<std::size_t>(got));
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string how_it_ended(int status, const CallLimits& limits) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGXCPU || signal == SIGKILL) {
    return "its reader took more than " + std::to_string(whole_seconds(limits.cpu_s)) +
           " s of processor time and was ended";
  }
  if (signal == SIGINT || signal == SIGTERM) return "its reader was interrupted";
  if (signal == SIGABRT) return "its reader gave up over something it did not expect";
  if (signal != 0) return "its reader crashed (" + std::string(::strsignal(signal)) + ")";
  return "its reader ended without an answer";
}

}  // namespace

Expected<std::string> guarded_call(const std::function<std::string()>& call,
                                   const CallLimits& limits) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return fail(std::string("no pipe: ") + std::strerror(errno));
  }
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) be_the_child(call, limits, parent, ends[1]);
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    return fail(std::string("no child process: ") + std::strerror(errno));
  }
  std::string bytes;
  if (!receive(ends[0], kPatience * limits.cpu_s, &bytes)) ::kill(child, SIGKILL);
  ::close(ends[0]);
  const int status = wait_for(child);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty()) {
    return fail(how_it_ended(status, limits));
  }
  const bool value = bytes.front() == kValue;
  bytes.erase(0, 1);
  if (!value) return fail(bytes);
  return bytes;
}

}  // namespace canopeer
