#include "program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

namespace canopeer::test {
namespace {

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void redirect(int descriptor, const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
  dup2(file, descriptor);
  close(file);
}

ProgramResult run(const std::vector<std::string>& arguments,
                  const std::function<void(pid_t, const std::filesystem::path& err)>& meanwhile) {
  const TemporaryDirectory directory;
  const auto out = directory / "out";
  const auto err = directory / "err";
  std::vector<std::string> words = {CANOPEER_EMULATOR, CANOPEER_PROGRAM};
  if (words.front().empty()) words.erase(words.begin());
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    redirect(STDOUT_FILENO, out);
    redirect(STDERR_FILENO, err);
    if (chdir(CANOPEER_SOURCE_DIR) == 0) execv(argv[0], argv.data());
    _exit(127);
  }
  meanwhile(child, err);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), content(out), content(err)};
}

void interrupt_when(pid_t child, const std::function<bool()>& due) {
  while (!due() && waitpid(child, nullptr, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(child, SIGINT);
}

}  // namespace

ProgramResult canopeer(const std::vector<std::string>& arguments) {
  return run(arguments, [](pid_t, const std::filesystem::path&) {});
}

ProgramResult canopeer_interrupted(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& file) {
  return run(arguments, [&](pid_t child, const std::filesystem::path&) {
    interrupt_when(child, [&] { return std::filesystem::exists(file); });
  });
}

ProgramResult canopeer_interrupted_when_it_speaks(const std::vector<std::string>& arguments) {
  return run(arguments, [&](pid_t child, const std::filesystem::path& err) {
    interrupt_when(child, [&] { return !content(err).empty(); });
  });
}

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (std::filesystem::temp_directory_path() / "canopeer_test_XXXXXX").string();
  path_ = mkdtemp(name.data());
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code code;
  std::filesystem::remove_all(path_, code);
}

}  // namespace canopeer::test
